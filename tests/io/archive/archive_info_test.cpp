// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_info.hpp"

#include "hypermap/io/codec/bounded_json.hpp"
#include "io/archive/sample_archive.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using testing::HasSubstr;

TEST(ArchiveInfo, CountsWhatEachLayerHolds) {
  const ArchiveInfo info = describe(test::sample_archive());
  EXPECT_EQ(info.format_version, 1);
  ASSERT_EQ(info.layers.size(), 5U);  // occupancy, semantic, octree, objects, class grid
  EXPECT_EQ(info.layers[0].cells->unknown + info.layers[0].cells->free +
                info.layers[0].cells->occupied + info.layers[0].cells->between,
            17U * 9U);
  EXPECT_EQ(info.layers[1].num_objects, 2U);
  EXPECT_EQ(info.layers[1].frame_id, "lab");
  // 100 leaves, log-odds i * 37 - 1000: negative for i < 28 (27 * 37 = 999).
  EXPECT_EQ(info.layers[2].leaves, (LeafCount{.occupied = 72, .free = 28}));
  EXPECT_EQ(info.layers[2].voxels, info.layers[2].leaves);
  // Keys 32768 to 32772 in x: 0 to 0.25 m.
  EXPECT_NEAR(info.layers[2].bounds->min().x(), 0.0, 1e-9);
  EXPECT_NEAR(info.layers[2].bounds->max().x(), 0.25, 1e-9);
  EXPECT_EQ(info.layers[3].num_objects, 1U);
  EXPECT_EQ(info.layers[4].name, "chair");
  EXPECT_EQ(info.classes.size(), 3U);
}

TEST(ArchiveInfo, ObjectsThatNoLayerShowsAreNotSureEnough) {
  MapArchive archive;
  const ObjectId sure = archive.objects.add(Object{});
  (void)archive.objects.add(Object{});
  const auto counts = [&] {
    const LayerSummary objects = describe(archive).layers.back();
    return std::pair(*objects.num_objects, *objects.num_tentative);
  };
  EXPECT_EQ(counts(), std::pair(std::size_t{2}, std::size_t{0})) << "no layer says otherwise";
  SemanticLayer layer;
  const Polygon footprint = make_polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}).value();
  ASSERT_TRUE(layer.add({.id = sure.value, .name = "chair", .parts = {footprint}}));
  ASSERT_TRUE(archive.hypermap.add_layer({LayerInfo{.name = "semantic"}, std::move(layer)}));
  EXPECT_EQ(counts(), std::pair(std::size_t{1}, std::size_t{1}));
}

// A leaf of depth 14 is 4 x 4 x 4 voxels, one of depth 16 a voxel.
TEST(ArchiveInfo, APrunedOctreeIsCountedInVoxelsToo) {
  MapArchive archive;
  archive.octomaps.push_back(
      {.entry = {.format = "octomap", .version = 1, .name = "octree"},
       .bytes = {},
       .tree = {.resolution_m = 0.1,
                .leaves = {{.key = {32768, 32768, 32768}, .depth = 14, .log_odds = -1.0F},
                           {.key = {32772, 32768, 32768}, .depth = 16, .log_odds = 1.0F}}}});
  const LayerSummary octree = describe(archive).layers.at(0);
  EXPECT_EQ(octree.leaves, (LeafCount{.occupied = 1, .free = 1}));
  EXPECT_EQ(octree.voxels, (LeafCount{.occupied = 1, .free = 64}));
}

TEST(ArchiveInfo, AnArchiveWithoutExtensionsHasVersionZero) {
  EXPECT_EQ(describe(MapArchive{}).format_version, 0);
}

TEST(ArchiveInfo, TellsOfTheDetectors) {
  MapArchive archive;
  EXPECT_EQ(describe(archive).format_version, 0);
  ASSERT_TRUE(archive.detectors.add({.name = "yolo", .architecture = "X", .classes = {"cup"}}));
  ASSERT_TRUE(archive.detectors.add({.name = "labels"}));
  const ArchiveInfo info = describe(archive);
  EXPECT_EQ(info.format_version, 1);
  EXPECT_THAT(to_json(info),
              HasSubstr(R"("detectors":[{"id":0,"name":"yolo","type":null,"architecture":"X",)"
                        R"("classes":["cup"]},{"id":1,"name":"labels","type":null,)"
                        R"("architecture":null,"classes":null}])"));
}

TEST(ArchiveInfo, TellsOfTheSessions) {
  MapArchive archive;
  archive.provenance.resize(2);
  archive.provenance[0].input = "lab";
  archive.provenance[0].session = "morning";
  archive.provenance[0].first_stamp = Stamp{1'500'000'000};
  archive.provenance[0].last_stamp = Stamp{2'000'000'000};
  EXPECT_THAT(to_json(describe(archive)),
              HasSubstr(R"("sessions":[{"number":1,"name":"morning","input":"lab","first_s":1.5,)"
                        R"("last_s":2.0},{"number":2,"name":null,"input":"","first_s":null,)"
                        R"("last_s":null}])"));
}

TEST(ArchiveInfo, TellsTheFlagsOfLayersWithTheirDefaults) {
  MapArchive archive = test::sample_archive();
  ASSERT_TRUE(archive.hypermap.add_layer(
      {{.name = "fixed", .load_file = false, .subscribe_mode = true, .enable_update = false},
       SemanticLayer()}));
  const ArchiveInfo info = describe(archive);
  ASSERT_EQ(info.layers.size(), 6U);
  EXPECT_EQ(info.layers[0].flags, LayerFlags{});
  EXPECT_EQ(info.layers[2].flags,
            (LayerFlags{.load_file = false, .subscribe_mode = true, .enable_update = false}));
  EXPECT_EQ(info.layers[3].flags, std::nullopt) << "the octree stands in no list of layers";
  const std::string text = to_json(info);
  EXPECT_THAT(text,
              HasSubstr(R"("name":"fixed","class":"SemanticLayer","frame_id":"map",)"
                        R"("load_file":false,"subscribe_mode":true,"enable_update":false)"));
  EXPECT_THAT(text,
              HasSubstr(R"("name":"occupancy","class":"OccupancyGridLayer","frame_id":"map",)"
                        R"("load_file":true,"subscribe_mode":false,"enable_update":true)"));
}

TEST(ArchiveInfo, ItsJsonHasTheFieldsThatScriptsRelyOn) {
  const std::string text = to_json(describe(test::sample_archive()));
  const auto document = JsonDocument::parse(text, "info");
  ASSERT_TRUE(document) << to_string(document.error());
  const JsonNode root = document->root();
  for (const char* key :
       {"format_version", "layers", "classes", "detectors", "transforms", "sessions", "provenance"})
    EXPECT_TRUE(root.find(key)) << key;
  const JsonNode first = root.find("layers")->at(0);
  EXPECT_EQ(first.find("class")->string().value(), "OccupancyGridLayer");
  EXPECT_TRUE(first.find("cells")->find("occupied"));
  EXPECT_EQ(first.find("bounds")->find("min")->size(), 2U);
  EXPECT_EQ(root.find("layers")->at(2).find("bounds")->find("min")->size(), 3U);
  EXPECT_EQ(root.find("classes")->at(2).find("name")->string().value(), "potted plant");
  EXPECT_THAT(text, HasSubstr("\"resolution_m\":0.05"));
}

}  // namespace
}  // namespace hypermap

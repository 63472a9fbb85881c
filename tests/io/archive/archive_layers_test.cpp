// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/archive_layers.hpp"

#include "hypermap/io/archive/map_query.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/codec/zip_writer.hpp"
#include "io/archive/sample_archive.hpp"
#include "projection/layers/layer_contract.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::ids_of;
using test::NumberLayer;
using test::rectangle;
using test::sample_archive;
using testing::ElementsAre;
using testing::HasSubstr;

const SourceName kOwnSource{.file = "own.hmap"};

LayerRegistry with_numbers() {
  LayerRegistry types;
  EXPECT_TRUE(types.add(NumberLayer(), NumberLayer::load));
  return types;
}

MapArchive archive_with_number() {
  MapArchive archive = sample_archive();
  LayerInfo info{.name = "number", .frame_id = "lab", .enable_update = true};
  info.extra = make_map({{"unit", make_text("apples")}});
  EXPECT_TRUE(archive.hypermap.add_layer({.info = info, .content = NumberLayer(7)}));
  return archive;
}

std::string content_of(const std::string& bytes, const std::string& name) {
  return ZipReader::create(view_bytes(bytes))->read(name).value();
}

/// The archive with a text in one member replaced.
std::string with_text(const std::string& bytes,
                      const std::string& member,
                      const std::string& from,
                      const std::string& to) {
  const auto zip = ZipReader::create(view_bytes(bytes));
  ZipWriter writer;
  for (const ZipMember& one : zip->members()) {
    std::string content = zip->read(one.name).value();
    if (one.name == member) {
      const std::size_t at = content.find(from);
      EXPECT_NE(at, std::string::npos) << content;
      content.replace(at, from.size(), to);
    }
    EXPECT_TRUE(writer.add(one.name, content));
  }
  return writer.finish().value();
}

std::string refusal(const std::string& bytes) {
  const auto loaded = parse_archive(bytes, kOwnSource, {}, with_numbers());
  return loaded ? "no error" : to_string(loaded.error());
}

TEST(ArchiveLayers, AreListedAsInfoTellsThem) {
  std::vector<std::string> names;
  const MapArchive archive = archive_with_number();
  for (const Layer& layer : archive_layers(archive)) names.push_back(layer.info.name);
  EXPECT_THAT(names, ElementsAre("occupancy", "semantic", "number", "octree", "objects", "chair"));
}

TEST(ArchiveLayers, AllKeepTheContractOfLayers) {
  const MapArchive archive = archive_with_number();
  for (const Layer& layer : archive_layers(archive)) {
    SCOPED_TRACE(layer.info.name);
    test::expect_layer_contract(*layer.content);
  }
}

TEST(ArchiveLayers, ObjectsCanAlwaysBeAsked) {
  const MapArchive nothing;
  EXPECT_TRUE(archive_layers(nothing).empty());
  const auto objects = archive_layer(nothing, "objects");
  ASSERT_TRUE(objects);
  test::expect_layer_contract(*objects->content);
  const auto unknown = archive_layer(sample_archive(), "smells");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().what, HasSubstr("occupancy, semantic, octree, objects, chair"));
  EXPECT_FALSE(archive_layer(nothing, "evidence")) << "of no octree there is none";
}

TEST(ArchiveLayers, EvidenceAnswersAsTheVoxelsOfTheOctree) {
  const MapArchive archive = sample_archive();
  const Layer octree = archive_layer(archive, "evidence").value();
  const auto all = octree.content->query({}).value();
  ASSERT_EQ(all.size(), 100U);
  for (const LayerAnswer& answer : all) {
    const auto leaf =
        archive.octree->at(PointInMap{{answer.position.x(), answer.position.y(), *answer.z_m}});
    ASSERT_TRUE(leaf);
    const double probability = leaf->occupancy.probability().value();
    EXPECT_NEAR(static_cast<double>(answer.value), 100.0 * probability, 0.5 + 1e-9);
    const std::string occupied =
        leaf->best_class ? archive.classes.name(*leaf->best_class) : "Occupied";
    EXPECT_EQ(answer.name, leaf->occupied ? occupied : "Free");
  }
}

TEST(ArchiveLayers, EveryPointOfAVoxelFindsItAndNoOther) {
  const MapArchive archive = sample_archive();
  const Layer octree = archive_layer(archive, "octree").value();
  // Keys 32768 .. 32772 in x, 32760 .. 32779 in y, 32770 in z, at 5 cm: lower faces belong to it.
  for (int step = 0; step < 40; ++step) {
    const PlanPoint point{{0.00625 * step, 0.01}, 0.12};
    const auto here = octree.content->query({.at = point}).value();
    ASSERT_EQ(here.size(), 1U) << step;
    const int voxel = step / 8;
    EXPECT_NEAR(here[0].position.x(), 0.025 + 0.05 * voxel, 1e-9) << step;
    EXPECT_TRUE(ids_of(*octree.content, {.at = PlanPoint{point.xy, 0.16}}).empty());
    EXPECT_EQ(ids_of(*octree.content, {.at = PlanPoint{point.xy}}).size(), 1U);
  }
  EXPECT_TRUE(ids_of(*octree.content, {.at = PlanPoint{{0.25, 0.01}, 0.12}}).empty());
}

TEST(ArchiveLayers, VoxelsOfAnAreaShareAreaWithIt) {
  const MapArchive archive = sample_archive();
  const Layer octree = archive_layer(archive, "octree").value();
  // Columns 1 and 2 in x (0.05 .. 0.15); rows -1 and 0 in y; edges alone do not count.
  const auto found =
      octree.content->query({.area = rectangle({0.05, -0.04}, {0.15, 0.05})}).value();
  for (const LayerAnswer& answer : found) {
    EXPECT_TRUE(answer.position.x() > 0.05 && answer.position.x() < 0.15);
    EXPECT_TRUE(answer.position.y() > -0.05 && answer.position.y() < 0.05);
  }
  EXPECT_EQ(found.size(), 4U);
}

TEST(ArchiveLayers, AClassGridAnswersByTheNameOfItsClass) {
  const MapArchive archive = sample_archive();
  const MapQuery query{.layer = "chair", .value = 49};
  const auto found = query_map(archive, query);
  ASSERT_TRUE(found) << to_string(found.error());
  EXPECT_EQ(found->frame_id, "map");
  EXPECT_FALSE(found->found.empty());
}

TEST(ArchiveLayers, ALayerOfARegisteredClassIsSavedAndLoaded) {
  const MapArchive archive = archive_with_number();
  const auto bytes = write_archive(archive);
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  const std::string config = content_of(*bytes, "hmap_config.yaml");
  const std::string extension =
      "  - format: NumberLayer\n    version: 3\n    name: number\n    frame_id: lab\n"
      "    file: number\n    enable_update: true\n    unit: apples\n";
  EXPECT_THAT(config, HasSubstr(extension));
  EXPECT_EQ(content_of(*bytes, "number.yaml"), "number: 7\n");
  const auto loaded = parse_archive(*bytes, kOwnSource, {}, with_numbers());
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->findings.empty());
  EXPECT_TRUE(loaded->value == archive);
  EXPECT_EQ(write_archive(loaded->value).value(), *bytes);
  EXPECT_EQ(query_map(loaded->value, {.layer = "number", .text = "7"})->found.size(), 1U);
}

/// A layer of a program that throws where it should return an error.
class ThrowingLayer final : public MapLayer {
 public:
  [[nodiscard]] std::string_view class_name() const override { return "ThrowingLayer"; }
  [[nodiscard]] LayerStatistics statistics() const override { return {}; }
  [[nodiscard]] Result<std::vector<LayerAnswer>> query(const LayerQuery& /*query*/) const override {
    return std::vector<LayerAnswer>{};
  }
  [[nodiscard]] std::vector<LayerPrimitive> draw() const override { return {}; }
  [[nodiscard]] bool equals(const MapLayer& other) const override { return this == &other; }
  [[nodiscard]] Result<void> save(LayerWriter& /*writer*/) const override {
    throw std::runtime_error("the sensor's table is gone");
  }
};

TEST(ArchiveLayers, WhatALayerThrowsIsNotCalledMemory) {
  MapArchive archive = sample_archive();
  ASSERT_TRUE(archive.hypermap.add_layer({.info = {.name = "own"}, .content = ThrowingLayer()}));
  const auto written = write_archive(archive);
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(written.error().what, "the archive: the sensor's table is gone");
}

TEST(ArchiveLayers, AProgramThatDoesNotKnowTheClassKeepsTheLayer) {
  const std::string bytes = write_archive(archive_with_number()).value();
  const auto stock = parse_archive(bytes, kOwnSource);
  ASSERT_TRUE(stock) << to_string(stock.error());
  EXPECT_EQ(stock->value.hypermap.find("number"), nullptr);
  const auto saved = write_archive(stock->value);
  ASSERT_TRUE(saved) << to_string(saved.error());
  EXPECT_EQ(content_of(*saved, "number.yaml"), content_of(bytes, "number.yaml"));
  EXPECT_EQ(content_of(*saved, "hmap_config.yaml"), content_of(bytes, "hmap_config.yaml"));
  const auto own = parse_archive(*saved, kOwnSource, {}, with_numbers());
  ASSERT_TRUE(own) << to_string(own.error());
  EXPECT_TRUE(own->value == archive_with_number());
}

TEST(ArchiveLayers, ASaveIsVerifiedWithTheTypesThatTheMapHas) {
  const test::TempDir dir;
  EXPECT_TRUE(save_archive(archive_with_number(), dir / "a.hmap", {.layers = with_numbers()}));
  const auto stock = save_archive(archive_with_number(), dir / "b.hmap");
  ASSERT_FALSE(stock);
  EXPECT_THAT(to_string(stock.error()), HasSubstr("not among SaveOptions::layers"));
}

TEST(ArchiveLayers, WhatALoaderRefusesNamesFileMemberAndField) {
  const std::string bytes = write_archive(archive_with_number()).value();
  EXPECT_EQ(refusal(with_text(bytes, "number.yaml", "7", "seven")),
            "own.hmap!number.yaml: number: must be an integer");
  EXPECT_THAT(refusal(with_text(bytes, "number.yaml", "number: 7", "[")), HasSubstr("number.yaml"));
  EXPECT_THAT(refusal(with_text(bytes, "hmap_config.yaml", "file: number", "file: nothing")),
              HasSubstr("extensions[7].file: names 'nothing.yaml', which is not there"));
  EXPECT_THAT(refusal(with_text(bytes, "hmap_config.yaml", "file: number", "file: ../x")),
              HasSubstr("extensions[7].file"));
  EXPECT_THAT(
      refusal(with_text(bytes, "hmap_config.yaml", "enable_update: true", "enable_update: 7")),
      HasSubstr("enable_update"));
}

TEST(ArchiveLayers, ANewerVersionIsRefusedByItsNumberAndAnOlderOneRead) {
  const std::string bytes = write_archive(archive_with_number()).value();
  const auto with_version = [&](const std::string& version) {
    return with_text(bytes,
                     "hmap_config.yaml",
                     "format: NumberLayer\n    version: 3",
                     "format: NumberLayer\n    version: " + version);
  };
  EXPECT_THAT(refusal(with_version("4")), HasSubstr("written by a newer version 4"));
  EXPECT_EQ(refusal(with_version("2")), "no error");
}

TEST(ArchiveLayers, ARegisteredClassIsReadAmongTheLayersToo) {
  ZipWriter writer;
  ASSERT_TRUE(writer.add("hmap_config.yaml",
                         "layers:\n  - {class: NumberLayer, name: n, frame_id: map, load_file: "
                         "true}\n  - {class: NumberLayer, name: m, frame_id: map, load_file: "
                         "false}\n"));
  ASSERT_TRUE(writer.add("n.yaml", "number: 5\n"));
  const auto loaded = parse_archive(writer.finish().value(), kOwnSource, {}, with_numbers());
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_EQ(*loaded->value.hypermap.find_as<NumberLayer>("n"), NumberLayer(5));
  EXPECT_EQ(*loaded->value.hypermap.find_as<NumberLayer>("m"), NumberLayer());
}

}  // namespace
}  // namespace hypermap

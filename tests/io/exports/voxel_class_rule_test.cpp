// SPDX-License-Identifier: BSD-3-Clause
// The class of a voxel is one, whatever shows it (docs/CONVENTIONS.md): queries, files, grids,
// images and layers of one map are held against each other.
#include "hypermap/io/archive/archive_layers.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/octomap_file.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/exports/map_export.hpp"
#include "hypermap/io/exports/map_stack.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;

constexpr ClassId kChair{0};
constexpr std::uint16_t kNoClassInPly = 0xFFFF;
/// Where the voxels stand, and what each of them shows.
constexpr std::array kXs{0.225, 0.325, 1.225, 2.225};
const std::vector<std::string> kShown{"chair", "chair", "Occupied", "Occupied"};

Object object_at(double x, ClassId class_id) {
  Object object;
  object.belief.observe(std::array{ClassEvidence{class_id, Probability(0.9)}}, Probability(0.5));
  object.box = {{x, 0.0, 0.0}, {x + 0.4, 0.4, 0.8}};
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector3d p(x + 0.02 * i, 0.225, 0.525);
    points.push_back(p.cast<float>());
  }
  object.points.observe(points);
  return object;
}

StoredLeaf voxel(const SemanticOctree& octree, double x, ObjectId object, std::uint16_t class_id) {
  VoxelLabel label;
  label.classes[0] = {class_id, 2000};
  label.object = object;
  label.object_votes = object == kNoObject ? 0 : 1;
  const auto key = octree.grid().key(PointInMap{{x, 0.225, 0.525}});
  return {.key = key.value(), .log_odds = 1000, .label = label};
}

/// A confirmed chair with two voxels, one of which reads "cup"; a false alarm of a giraffe that was
/// never confirmed; a voxel of an object that was removed.
MapArchive room() {
  MapArchive archive;
  for (const char* name : {"chair", "cup", "giraffe"}) (void)archive.classes.add(name).value();
  Object chair = object_at(0.0, kChair);
  chair.existence = LogOdds(5.0);
  chair.num_observations = 20;
  const ObjectId confirmed = archive.objects.add(chair);
  const ObjectId alarm = archive.objects.add(object_at(1.0, ClassId{2}));
  archive.octree = SemanticOctree::create({}).value();
  SemanticOctree& octree = *archive.octree;
  EXPECT_TRUE(octree.set_leaf(voxel(octree, kXs[0], confirmed, 0)));
  EXPECT_TRUE(octree.set_leaf(voxel(octree, kXs[1], confirmed, 1)));
  EXPECT_TRUE(octree.set_leaf(voxel(octree, kXs[2], alarm, 2)));
  EXPECT_TRUE(octree.set_leaf(voxel(octree, kXs[3], kNoObject, 1)));
  EXPECT_TRUE(derive_layers(archive, {}, {}));
  EXPECT_THAT(confirmed_ids_of(archive), ElementsAre(confirmed));
  return archive;
}

std::vector<std::string> answers(const MapArchive& archive, std::string_view name) {
  const Layer layer = archive_layer(archive, name).value();
  std::vector<std::string> found;
  for (const double x : kXs) {
    const auto at = layer.content->query({.at = PlanPoint{{x, 0.225}, 0.525}}).value();
    found.push_back(at.size() == 1 ? at.front().name : std::to_string(at.size()) + " answers");
  }
  return found;
}

std::string exported_bytes(const MapArchive& archive,
                           ExportFormat format,
                           const std::string& name) {
  const test::TempDir dir;
  EXPECT_TRUE(
      export_map(archive, {.format = format, .output = dir / name, .layer = {}, .classes = {}}));
  return read_file(dir / name, 1U << 20U).value_or("");
}

TEST(VoxelClass, QueriesOfTheOctree) {
  EXPECT_EQ(answers(room(), "octree"), kShown);
}

TEST(VoxelClass, TheEvidenceOfEachVoxelIsThereByName) {
  EXPECT_THAT(answers(room(), "evidence"), ElementsAre("chair", "cup", "giraffe", "cup"));
}

TEST(VoxelClass, ImagesOfTheMap) {
  const MapArchive archive = room();
  const Layer layer = archive_layer(archive, "octree").value();
  const auto drawn = layer.content->draw();
  ASSERT_EQ(drawn.size(), 1U);
  std::vector<std::string> classes;
  std::get<DrawnVoxels>(drawn.front()).leaves([&](const LeafSample& leaf) {
    classes.push_back(leaf.best_class ? archive.classes.name(*leaf.best_class) : "Occupied");
  });
  EXPECT_EQ(classes, kShown);
}

TEST(VoxelClass, Ply) {
  const std::string ply = exported_bytes(room(), ExportFormat::kPly, "a.ply");
  const std::string end = "end_header\n";
  const std::string body = ply.substr(ply.find(end) + end.size());
  constexpr std::size_t kVertexBytes = 25;
  ASSERT_EQ(body.size(), kXs.size() * kVertexBytes);
  std::vector<std::uint16_t> labels;
  std::vector<std::int32_t> instances;
  for (std::size_t i = 0; i < kXs.size(); ++i) {
    std::uint16_t label = 0;
    std::int32_t instance = 0;
    std::memcpy(&label, &body[i * kVertexBytes + 15], sizeof label);
    std::memcpy(&instance, &body[i * kVertexBytes + 17], sizeof instance);
    labels.push_back(label);
    instances.push_back(instance);
  }
  EXPECT_THAT(labels, ElementsAre(0, 0, kNoClassInPly, kNoClassInPly));
  EXPECT_THAT(instances, ElementsAre(1, 1, 0, 0));
}

TEST(VoxelClass, OctreesInColour) {
  const auto tree =
      parse_octomap(exported_bytes(room(), ExportFormat::kColorOctomap, "a.ot"), {.file = "a.ot"});
  ASSERT_TRUE(tree) << to_string(tree.error());
  const std::vector<Rgb8>& colors = tree->value.colors;
  ASSERT_EQ(colors.size(), 4U);
  EXPECT_EQ(colors[0], colors[1]);
  EXPECT_EQ(colors[2], colors[3]);
  EXPECT_FALSE(colors[0] == colors[2]);
}

TEST(VoxelClass, OctreesOfAClass) {
  const test::TempDir dir;
  const MapArchive archive = room();
  const auto written = [&](const char* class_name) {
    return export_map(archive,
                      {.format = ExportFormat::kOctomap,
                       .output = dir / "a.ot",
                       .layer = {},
                       .classes = {class_name}})
        .value();
  };
  EXPECT_EQ(written("chair").size(), 1U);
  const auto tree = read_octomap(dir / "a.ot");
  ASSERT_TRUE(tree);
  EXPECT_EQ(tree->value.leaves.size(), 2U);
  EXPECT_TRUE(written("cup").empty());
  EXPECT_TRUE(written("giraffe").empty());
}

TEST(VoxelClass, ClassGridsAndTheSemanticLayer) {
  const MapArchive archive = room();
  ASSERT_EQ(archive.class_grids.size(), 1U);
  EXPECT_EQ(archive.class_grids.front().class_name, "chair");
  const auto* semantic = archive.hypermap.find_as<SemanticLayer>("semantic");
  ASSERT_NE(semantic, nullptr);
  ASSERT_EQ(semantic->objects().size(), 1U);
  EXPECT_EQ(semantic->objects().front().name, "chair");
}

TEST(VoxelClass, Stacks) {
  const GridStack stack = stack_of_map(room(), {}).value();
  ASSERT_EQ(stack.layers().size(), 1U);
  const LogOddsGrid& chair = stack.layers().at("/ism/chair");
  for (std::size_t i = 0; i < kXs.size(); ++i) {
    const auto cell = cell_at(stack.geometry(), {kXs[i], 0.225});
    EXPECT_EQ(chair.at(cell.value()) > 0, kShown[i] == "chair") << kXs[i];
    EXPECT_NE(chair.at(cell.value()), 0);
  }
}

}  // namespace
}  // namespace hypermap

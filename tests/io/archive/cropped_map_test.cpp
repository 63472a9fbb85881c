// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/cropped_map.hpp"

#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "io/archive/sample_archive.hpp"
#include "io/archive/wide_map.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::rectangle;
using test::shape_at;
using test::wide_map;
using testing::ElementsAre;
using testing::IsEmpty;

std::set<ObjectId> ids_in_part(const MapArchive& archive) {
  std::set<ObjectId> ids;
  for (const Object& object : archive.objects.objects()) ids.insert(object.id);
  return ids;
}

const OccupancyGrid& grid_of(const MapArchive& archive) {
  return archive.hypermap.find("occupancy")->content.as<OccupancyLayer>()->grid;
}

const SemanticLayer& shapes_of(const MapArchive& archive) {
  return *archive.hypermap.find("semantic")->content.as<SemanticLayer>();
}

std::size_t num_voxels(const MapArchive& archive) {
  const LeafCount count = archive.octree->num_leaves();
  return count.occupied + count.free;
}

TEST(CroppedMap, HoldsWhatLiesInTheRegion) {
  const MapArchive whole = wide_map();
  const CropRegion region{.area = rectangle(-1, -2, 3, 1), .min_z_m = 0.5, .max_z_m = 1.5};
  const auto part = cropped(whole, region).value();
  EXPECT_THAT(part.left_out, IsEmpty());
  std::size_t expected_voxels = 0;
  whole.octree->for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const Eigen::Vector3d at = whole.octree->grid().centre(leaf.key).xyz;
    const bool is_inside =
        at.x() >= -1 && at.x() < 3 && at.y() >= -2 && at.y() < 1 && at.z() >= 0.5 && at.z() < 1.5;
    expected_voxels += is_inside ? 1U : 0U;
    EXPECT_EQ(part.map.octree->stored_at(leaf.key).has_value(), is_inside);
  });
  EXPECT_EQ(num_voxels(part.map), expected_voxels);
  for (const Object& object : whole.objects.objects()) {
    const Eigen::Vector3d& at = object.centroid_in_map;
    const bool is_inside =
        at.x() >= -1 && at.x() < 3 && at.y() >= -2 && at.y() < 1 && at.z() >= 0.5 && at.z() < 1.5;
    EXPECT_EQ(part.map.objects.contains(object.id), is_inside);
    EXPECT_EQ(part.map.views.contains(object.id), is_inside);
    EXPECT_EQ(shapes_of(part.map).find(object.id.value) != nullptr, is_inside);
    if (is_inside) {
      EXPECT_EQ(part.map.objects.at(object.id), object);
    }
  }
  EXPECT_EQ(grid_of(part.map).geometry(),
            (GridGeometry{.resolution_m = 0.25, .origin = {-1, -2}, .cols = 16, .rows = 12}));
  EXPECT_EQ(part.map.class_grids.at(0).grid, grid_of(part.map));
  const TopologicalMap& places = *part.map.topological_map;
  for (const TopologicalVertex& vertex : places.vertices()) {
    EXPECT_TRUE(region.contains(vertex.position_in_map) || vertex.kind == VertexKind::kSupport);
  }
  // [smap] 3.5.1: each object has a vertex nearer than V_d, though that may have been outside.
  for (const Object& object : part.map.objects.objects()) {
    const auto nearest = places.nearest(object.centroid_in_map);
    ASSERT_TRUE(nearest.has_value());
    EXPECT_LT((places.vertices()[nearest->value].position_in_map - object.centroid_in_map).norm(),
              places.options().vertex_distance_m);
  }
}

TEST(CroppedMap, VoxelsOfObjectsElsewhereAreOfNone) {
  const auto part = cropped(wide_map(), {.area = rectangle(0, 0, 4, 3)}).value().map;
  std::size_t num_of_none = 0;
  part.octree->for_each_label([&](const VoxelLabel& label) {
    num_of_none += label.object == kNoObject ? 1U : 0U;
    EXPECT_TRUE(label.object == kNoObject || part.objects.contains(label.object));
  });
  EXPECT_GT(num_of_none, 0U);
}

// Regions that divide the plane have everything once, and the part can be saved.
TEST(CroppedMap, TilesHaveEachVoxelCellAndObjectOnce) {
  const MapArchive whole = wide_map();
  const test::TempDir folder;
  std::size_t voxels = 0;
  std::size_t cells = 0;
  std::multiset<ObjectId> ids;
  const auto tiles = map_tiles(whole, 1.7).value();
  EXPECT_GT(tiles.size(), 10U);
  for (const CropRegion& tile : tiles) {
    const auto part = cropped(whole, tile).value().map;
    voxels += num_voxels(part);
    cells += grid_of(part).counts().free;
    const std::set<ObjectId> of_part = ids_in_part(part);
    ids.insert(of_part.begin(), of_part.end());
  }
  EXPECT_EQ(voxels, num_voxels(whole));
  EXPECT_EQ(cells, grid_of(whole).counts().free);
  const std::set<ObjectId> all = ids_in_part(whole);
  EXPECT_EQ(ids, std::multiset<ObjectId>(all.begin(), all.end()));
}

TEST(CroppedMap, OfASampleCanBeSavedAndLoaded) {
  MapArchive whole = test::sample_archive();
  const test::TempDir folder;
  for (const Polygon& area : {rectangle(-1, -1, 1, 0.2), rectangle(50, 50, 51, 51)}) {
    const auto part = cropped(whole, {.area = area});
    ASSERT_TRUE(part) << to_string(part.error());
    const auto saved = save_archive(part->map, folder.path() / "part.hmap");
    EXPECT_TRUE(saved) << to_string(saved.error());
    EXPECT_EQ(part->map.classes, whole.classes);
    EXPECT_EQ(part->map.provenance, whole.provenance);
  }
}

TEST(CroppedMap, LayersInOtherFramesAreCroppedWhereTheyLie) {
  MapArchive whole = wide_map();
  EXPECT_TRUE(whole.hypermap.frames().add(
      {.frame_id = "map", .child_frame_id = "aside", .x_m = 10.0, .y_m = 0.0, .yaw_rad = 0.0}));
  EXPECT_TRUE(whole.hypermap.add_layer(
      {.info = {.name = "marks", .frame_id = "aside", .file = "marks"},
       .content =
           SemanticLayer::create({shape_at(900, -9.5, 0.5), shape_at(901, 0.5, 0.5)}).value()}));
  EXPECT_TRUE(whole.hypermap.add_layer(
      {.info = {.name = "lost", .frame_id = "nowhere", .file = "lost"},
       .content = SemanticLayer::create({shape_at(900, 0.5, 0.5)}).value()}));
  const auto part = cropped(whole, {.area = rectangle(0, 0, 2, 2)}).value();
  const auto& marks = *part.map.hypermap.find("marks")->content.as<SemanticLayer>();
  EXPECT_EQ(marks.objects().size(), 1U);
  EXPECT_NE(marks.find(900), nullptr);
  EXPECT_THAT(part.left_out, ElementsAre("lost"));
  EXPECT_EQ(part.map.hypermap.find("lost"), nullptr);
}

// A border belongs to the region above it and to its right.
TEST(CropRegion, IsHalfOpen) {
  const CropRegion region{.area = rectangle(0, 0, 1, 1), .min_z_m = 0, .max_z_m = 2};
  EXPECT_TRUE(region.contains(Eigen::Vector3d(0, 0, 0)));
  EXPECT_FALSE(region.contains(Eigen::Vector2d(1, 0.5)));
  EXPECT_FALSE(region.contains(Eigen::Vector2d(0.5, 1)));
  EXPECT_FALSE(region.contains(Eigen::Vector3d(0.5, 0.5, 2)));
  CropRegion with_hole = region;
  with_hole.area.holes = {{{0.2, 0.2}, {0.2, 0.8}, {0.8, 0.8}, {0.8, 0.2}}};
  EXPECT_FALSE(with_hole.contains(Eigen::Vector2d(0.5, 0.5)));
  EXPECT_TRUE(with_hole.contains(Eigen::Vector2d(0.1, 0.5)));
}

TEST(CropRegion, IsCheckedByField) {
  const MapArchive whole = test::sample_archive();
  EXPECT_EQ(cropped(whole, {.area = {}}).error().field, "area");
  EXPECT_EQ(
      cropped(whole, {.area = rectangle(0, 0, 1, 1), .min_z_m = 1, .max_z_m = 1}).error().field,
      "max_z_m");
  EXPECT_EQ(map_tiles(whole, 0.0).error().field, "edge_m");
  EXPECT_EQ(map_tiles(whole, std::numeric_limits<double>::quiet_NaN()).error().field, "edge_m");
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A small map in which every part of an archive has something to say.
#pragma once

#include "hypermap/io/archive/map_archive.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace hypermap::test {

inline OccupancyGrid sample_grid(std::int8_t offset) {
  GridGeometry geometry;
  geometry.resolution_m = 0.05;
  geometry.origin = {-1.0 / 3.0, 0.1};
  geometry.cols = 17;
  geometry.rows = 9;
  std::vector<std::int8_t> cells;
  for (std::size_t i = 0; i < geometry.num_cells(); ++i)
    cells.push_back(static_cast<std::int8_t>((static_cast<int>(i) + offset) % 102 - 1));
  return OccupancyGrid::create(geometry, cells).value();
}

inline SemanticObject sample_shape(std::uint64_t id, const std::string& name, double x) {
  SemanticObject object;
  object.id = id;
  object.name = name;
  object.parts = {make_polygon({{x, 0}, {x + 0.1, 0}, {x + 0.1, 1.0 / 3.0}, {x, 0.3}}).value()};
  return object;
}

inline SemanticOctree sample_octree() {
  std::vector<StoredLeaf> leaves;
  for (std::uint16_t i = 0; i < 100; ++i) {
    StoredLeaf leaf;
    leaf.key = {static_cast<std::uint16_t>(32768 + i % 5),
                static_cast<std::uint16_t>(32760 + i / 5),
                32770};
    leaf.log_odds = static_cast<MilliLogOdds>(i * 37 - 1000);
    if (leaf.log_odds > 0) {
      leaf.label = VoxelLabel{};
      leaf.label->classes[0] = {.class_id = static_cast<std::uint16_t>(i % 3), .log_odds = 1500};
      leaf.label->object = ObjectId{1};
      leaf.label->object_votes = 2;
    }
    leaves.push_back(leaf);
  }
  return SemanticOctree::from_leaves({}, leaves).value();
}

inline Object sample_object() {
  Object object;
  object.belief.observe(std::vector<ClassEvidence>{{ClassId{2}, Probability(0.6180339887498949)}},
                        Probability(1.0 / 80.0));
  object.existence = LogOdds(1.0 / 3.0);
  object.box.max_in_map = {0.1, 0.2, 0.3};
  object.centroid_in_map = {0.05, 0.1, 0.15};
  object.histogram.observe(0.3, 1.7);
  object.shapes.add(make_polygon({{0, 0}, {0.1, 0}, {0.1, 0.2}}).value());
  object.points.observe(std::vector<Eigen::Vector3f>{{0.05F, 0.1F, 0.1F}});
  object.embeddings.observe(
      std::vector<Embedding>{{"clip", {3.0F, 0.0F, -4.0F}}, {"dino", {1.0F}}});
  object.num_observations = 1;
  return object;
}

inline MapArchive sample_archive() {
  MapArchive archive;
  EXPECT_TRUE(archive.hypermap.add_layer({.info = {.name = "occupancy", .file = "occupancy"},
                                          .content = OccupancyLayer(sample_grid(3))}));
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "semantic", .frame_id = "lab", .file = "semantic"},
       .content = SemanticLayer::create({sample_shape(0, "sink", 0.1), sample_shape(1, "cup", 2)})
                      .value()}));
  EXPECT_TRUE(archive.hypermap.frames().add(
      {.frame_id = "map", .child_frame_id = "lab", .x_m = 0.1, .y_m = 1.0 / 3.0, .yaw_rad = 0.7}));
  for (const char* name : {"chair", "table", "potted plant"})
    EXPECT_TRUE(archive.classes.add(name));
  archive.octree = sample_octree();
  archive.objects.add(sample_object());
  archive.class_grids = {{.class_name = "chair", .grid = sample_grid(50)}};
  archive.provenance.emplace_back();
  archive.provenance.back().tool = "hypermap 0.1.0";
  archive.provenance.back().input = "kitchen";
  archive.provenance.back().input_hash = "xxh3-128:00";
  archive.provenance.back().options = make_map({{"resolution_m", make_number(0.05)}});
  return archive;
}

}  // namespace hypermap::test

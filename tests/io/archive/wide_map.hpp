// SPDX-License-Identifier: BSD-3-Clause
// A map of some metres each way, with a bit of everything that lies somewhere.
#pragma once

#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "io/archive/sample_archive.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace hypermap::test {

inline Polygon rectangle(double x_min, double y_min, double x_max, double y_max) {
  return {.outer = {{x_min, y_min}, {x_max, y_min}, {x_max, y_max}, {x_min, y_max}}, .holes = {}};
}

inline SemanticObject shape_at(std::uint64_t id, double x_m, double y_m) {
  SemanticObject shape;
  shape.id = id;
  shape.name = "chair";
  shape.parts = {rectangle(x_m - 0.2, y_m - 0.2, x_m + 0.2, y_m + 0.2)};
  return shape;
}

/// Voxels, cells, objects with their shapes, and places, all over 8 m by 6 m around the origin.
inline MapArchive wide_map() {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> x_m(-4.0, 4.0);
  std::uniform_real_distribution<double> y_m(-3.0, 3.0);
  std::uniform_real_distribution<double> z_m(0.0, 2.0);
  MapArchive archive;
  archive.classes.add("chair").value();
  archive.octree = SemanticOctree::create({}).value();
  std::vector<SemanticObject> shapes;
  TopologicalMap places;
  for (int i = 0; i < 40; ++i) {
    Object object = sample_object();
    object.centroid_in_map = {x_m(engine), y_m(engine), z_m(engine)};
    object.box = {object.centroid_in_map.array() - 0.2, object.centroid_in_map.array() + 0.2};
    const Eigen::Vector3d centroid = object.centroid_in_map;
    const ObjectId id = archive.objects.add(std::move(object));
    // A shape whose middle is elsewhere goes with its object all the same.
    shapes.push_back(shape_at(id.value, centroid.x() + 0.3, centroid.y()));
    archive.views[id] = {.quality = 1.0, .jpeg = "none"};
    (void)places.observe({x_m(engine), y_m(engine), 1.0});
    for (int k = 0; k < 100; ++k) {
      StoredLeaf leaf;
      leaf.key =
          archive.octree->grid().key(PointInMap{{x_m(engine), y_m(engine), z_m(engine)}}).value();
      leaf.log_odds = 2000;
      leaf.label = VoxelLabel{};
      leaf.label->object = id;
      leaf.label->object_votes = 1;
      EXPECT_TRUE(archive.octree->set_leaf(leaf));
    }
  }
  archive.topological_map = places;
  OccupancyGrid grid =
      OccupancyGrid::create({.resolution_m = 0.25, .origin = {-4, -3}, .cols = 32, .rows = 24},
                            kFreeCell)
          .value();
  archive.class_grids = {{.class_name = "chair", .grid = grid}};
  EXPECT_TRUE(archive.hypermap.add_layer({.info = {.name = "occupancy", .file = "occupancy"},
                                          .content = OccupancyLayer(std::move(grid))}));
  EXPECT_TRUE(
      archive.hypermap.add_layer({.info = {.name = "semantic", .file = "semantic"},
                                  .content = SemanticLayer::create(std::move(shapes)).value()}));
  return archive;
}

}  // namespace hypermap::test

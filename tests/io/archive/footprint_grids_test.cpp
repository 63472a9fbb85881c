// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/footprint_grids.hpp"

#include "hypermap/projection/layers/occupancy_layer.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <utility>

namespace hypermap {
namespace {

SemanticObject square(std::uint64_t id, const std::string& name, Eigen::Vector2d at, double edge) {
  SemanticObject object;
  object.id = id;
  object.name = name;
  const Eigen::Vector2d to = at.array() + edge;
  object.parts = {make_polygon({at, {to.x(), at.y()}, to, {at.x(), to.y()}}).value()};
  return object;
}

MapArchive map_of(std::vector<SemanticObject> objects, const std::string& frame_id = "map") {
  MapArchive archive;
  EXPECT_TRUE(
      archive.hypermap.add_layer({.info = {.name = "things", .frame_id = frame_id},
                                  .content = SemanticLayer::create(std::move(objects)).value()}));
  return archive;
}

/// Four cells of a metre by two, of which the left two of the lower row are seen.
OccupancyGrid seen_grid(double yaw_rad = 0.0) {
  OccupancyGrid grid =
      OccupancyGrid::create({.resolution_m = 1.0, .yaw_rad = yaw_rad, .cols = 4, .rows = 2},
                            kUnknownCell)
          .value();
  grid.set({0, 0}, kFreeCell);
  grid.set({1, 0}, kOccupiedCell);
  return grid;
}

TEST(FootprintGrids, OneForEachNameOnTheCellsOfTheOccupancy) {
  MapArchive archive = map_of({square(1, "tv", {0.2, 0.2}, 0.1), square(2, "bed", {2, 0}, 2.0)});
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy"}, .content = OccupancyLayer(seen_grid())}));
  const FootprintGrids made = footprint_grids(archive).value();
  EXPECT_EQ(made.layer, "things");
  ASSERT_EQ(made.grids.size(), 2U);
  const OccupancyGrid& bed = made.grids[0].grid;
  const OccupancyGrid& tv = made.grids[1].grid;
  EXPECT_EQ(made.grids[0].class_name, "bed");
  EXPECT_EQ(bed.geometry(), seen_grid().geometry());
  EXPECT_EQ(bed.counts().occupied, 4U);
  EXPECT_EQ(bed.at({1, 0}), kFreeCell) << "an obstacle, and no bed";
  EXPECT_EQ(bed.at({0, 1}), kUnknownCell);
  EXPECT_EQ(tv.counts().occupied, 1U) << "a hundredth of a cell is not lost";
  EXPECT_EQ(tv.at({0, 0}), kOccupiedCell);
}

TEST(FootprintGrids, TheGridGoesOnToHoldWhatStandsBesideIt) {
  const double yaw_rad = std::numbers::pi / 2.0;  // x of the cells is y of the map
  MapArchive archive = map_of({square(1, "tree", {0.25, -2.5}, 0.5)});
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy"}, .content = OccupancyLayer(seen_grid(yaw_rad))}));
  const OccupancyGrid tree = footprint_grids(archive).value().grids.at(0).grid;
  EXPECT_EQ(tree.geometry().cols, 7) << "from y = -3 to 4";
  EXPECT_EQ(tree.geometry().rows, 3) << "from x = 1 to -2";
  EXPECT_EQ(tree.at_point({0.5, -2.2}), kOccupiedCell);
  EXPECT_EQ(tree.at_point({-0.5, 0.5}), kFreeCell) << "cell (0, 0) of the old grid";
  EXPECT_EQ(tree.at_point({-0.5, 1.5}), kFreeCell);
  EXPECT_EQ(tree.counts().free, 2U);
}

TEST(FootprintGrids, WithoutAGridInItsFrameNothingButTheShapesIsKnown) {
  MapArchive archive = map_of({square(1, "cup", {1.0, 2.0}, 0.1)}, "attic");
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy"}, .content = OccupancyLayer(seen_grid())}));
  const ClassGrid cup = footprint_grids(archive).value().grids.at(0);
  EXPECT_EQ(cup.frame_id, "attic");
  EXPECT_EQ(cup.grid.geometry().resolution_m, 0.05);
  EXPECT_EQ(cup.grid.counts().free, 0U);
  EXPECT_EQ(cup.grid.at_point({1.05, 2.05}), kOccupiedCell);
}

TEST(FootprintGrids, WhatIsNotThereIsSaid) {
  EXPECT_EQ(footprint_grids({}).error().code, ErrorCode::kNotFound);
  EXPECT_TRUE(footprint_grids(map_of({}))->grids.empty());
  const MapArchive wide = map_of({square(1, "a", {0, 0}, 1.0), square(2, "b", {90'000, 0}, 1.0)});
  EXPECT_EQ(footprint_grids(wide).error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace hypermap

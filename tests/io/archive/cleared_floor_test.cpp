// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/cleared_floor.hpp"

#include "hypermap/projection/layers/semantic_layer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace hypermap {
namespace {

using testing::HasSubstr;

/// Four cells of a metre by two; a wall at the left, a cupboard over the cells from x = 1.5 to 3.
MapArchive cupboard_map(const std::string& frame_id) {
  OccupancyGrid grid =
      OccupancyGrid::create({.resolution_m = 1.0, .cols = 4, .rows = 2}, kOccupiedCell).value();
  grid.set({3, 0}, kUnknownCell);
  MapArchive archive;
  EXPECT_TRUE(archive.hypermap.add_layer(
      {.info = {.name = "occupancy"}, .content = OccupancyLayer(std::move(grid))}));
  SemanticObject cupboard;
  cupboard.name = "cupboard";
  cupboard.parts = {make_polygon({{1.5, 0}, {3, 0}, {3, 1.4}, {1.5, 1.4}}).value()};
  EXPECT_TRUE(archive.hypermap.add_layer({.info = {.name = "semantic", .frame_id = frame_id},
                                          .content = SemanticLayer::create({cupboard}).value()}));
  return archive;
}

TEST(ClearedFloor, WhatAnObjectCoversByHalfIsFreeAndTheRestStays) {
  const MapArchive archive = cupboard_map("map");
  const auto cleared = without_objects(archive, *archive.hypermap.find("occupancy")).value().grid;
  EXPECT_EQ(cleared.at({0, 0}), kOccupiedCell) << "the wall";
  EXPECT_EQ(cleared.at({1, 0}), kFreeCell) << "covered by half";
  EXPECT_EQ(cleared.at({2, 0}), kFreeCell);
  EXPECT_EQ(cleared.at({2, 1}), kOccupiedCell) << "covered by 0.4";
  EXPECT_EQ(cleared.at({3, 0}), kUnknownCell);
}

// Beside the cell that is covered by 0.4 lie one that nobody saw and the grid's edge: it might be a
// wall. As an obstacle in the open it goes.
TEST(ClearedFloor, RimsGoWhereThatIsAskedFor) {
  MapArchive archive = cupboard_map("map");
  const Layer& walled = *archive.hypermap.find("occupancy");
  EXPECT_EQ(without_objects(archive, walled, ObjectRims::kGo)->grid.at({2, 1}), kOccupiedCell);
  OccupancyGrid open =
      OccupancyGrid::create({.resolution_m = 1.0, .origin = {0, -2}, .cols = 6, .rows = 6},
                            kFreeCell)
          .value();
  for (const Cell cell : {Cell{1, 2}, Cell{2, 2}, Cell{1, 3}, Cell{2, 3}}) {
    open.set(cell, kOccupiedCell);
  }
  const Layer occupancy{.info = {.name = "open"}, .content = OccupancyLayer(std::move(open))};
  EXPECT_EQ(without_objects(archive, occupancy)->grid.counts().occupied, 2U);
  EXPECT_EQ(without_objects(archive, occupancy, ObjectRims::kGo)->grid.counts().occupied, 0U);
}

TEST(ClearedFloor, AnotherFrameIsRefusedAndNoObjectsChangeNothing) {
  const MapArchive elsewhere = cupboard_map("attic");
  const auto refused = without_objects(elsewhere, *elsewhere.hypermap.find("occupancy"));
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(refused.error().what, HasSubstr("attic"));
  MapArchive bare = cupboard_map("map");
  bare.hypermap.remove_layer("semantic");
  const Layer& occupancy = *bare.hypermap.find("occupancy");
  EXPECT_EQ(without_objects(bare, occupancy).value(), *occupancy.content.as<OccupancyLayer>());
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

TEST(OccupancyGrid, StringsAreThoseOfTheText) {
  // [hypermap] 3.3.3: "Free" if 0, "Occupied" if 100, "Unknown" otherwise.
  EXPECT_EQ(occupancy_string(0), "Free");
  EXPECT_EQ(occupancy_string(100), "Occupied");
  for (const int value : {-1, 1, 50, 99}) {
    EXPECT_EQ(occupancy_string(static_cast<std::int8_t>(value)), "Unknown");
  }
}

TEST(OccupancyGrid, RowZeroIsAtTheBottom) {
  const auto grid = OccupancyGrid::create({.resolution_m = 1.0, .cols = 2, .rows = 2},
                                          std::vector<std::int8_t>{0, 1, 2, 3});
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->at_point({0.5, 0.5}), 0);
  EXPECT_EQ(grid->at_point({1.5, 0.5}), 1);
  EXPECT_EQ(grid->at_point({0.5, 1.5}), 2);
  EXPECT_FALSE(grid->at_point({0.5, 2.0}));
}

TEST(OccupancyGrid, CellsAreCountedByKind) {
  auto grid = OccupancyGrid::create({.resolution_m = 1.0, .cols = 3, .rows = 2});
  grid->set({0, 0}, 100);
  grid->set({1, 0}, 0);
  grid->set({2, 0}, 40);
  const OccupancyCounts counts = grid->counts();
  EXPECT_EQ(counts.occupied, 1U);
  EXPECT_EQ(counts.free, 1U);
  EXPECT_EQ(counts.between, 1U);
  EXPECT_EQ(counts.unknown, 3U);
}

TEST(OccupancyGrid, WhatIsNoOccupancyOrDoesNotFitIsRefused) {
  const GridGeometry two{.resolution_m = 1.0, .cols = 2, .rows = 1};
  EXPECT_EQ(OccupancyGrid::create(two, std::int8_t{101}).error().field, "occupancy");
  EXPECT_EQ(OccupancyGrid::create(two, std::int8_t{-2}).error().field, "occupancy");
  EXPECT_EQ(OccupancyGrid::create(two, std::vector<std::int8_t>{0, 120}).error().field,
            "occupancy");
  EXPECT_EQ(OccupancyGrid::create(two, std::vector<std::int8_t>{0}).error().field, "cells");
  EXPECT_FALSE(OccupancyGrid::create({.resolution_m = 0.0}));
  EXPECT_EQ(OccupancyGrid().cells().size(), 0U);
}

}  // namespace
}  // namespace hypermap

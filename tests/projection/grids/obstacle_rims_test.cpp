// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/obstacle_rims.hpp"

#include "drawn_plan.hpp"
#include "hypermap/projection/grids/rooms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using test::drawn_plan;
using testing::ElementsAreArray;

using Rows = std::vector<std::string>;

Rows rows_of_grid(const OccupancyGrid& grid) {
  Rows rows;
  for (int row = grid.geometry().rows - 1; row >= 0; --row) {
    std::string& text = rows.emplace_back();
    for (int col = 0; col < grid.geometry().cols; ++col) {
      const std::int8_t value = grid.at({col, row});
      text += value == kUnknownCell ? '?' : value == kFreeCell ? '.' : '#';
    }
  }
  return rows;
}

Polygon box_between(double x0, double y0, double x1, double y1) {
  return make_polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}).value();
}

Rows cleared(const Rows& rows, const std::vector<Polygon>& obstacles) {
  return rows_of_grid(without_rims(without_obstacles(drawn_plan(rows), obstacles), obstacles));
}

TEST(WithObstacles, OccupyFreeCellsThatTheyCoverByHalf) {
  OccupancyGrid grid = drawn_plan({"....", "?..#"});
  grid.set({1, 0}, 49);
  // All of the first row, half of the second one but for the last cell, of which it has a bit less.
  const std::vector<Polygon> obstacles{
      box_between(0, 0, 4, 1), box_between(0, 1, 3, 1.5), box_between(3, 1, 4, 1.49)};
  EXPECT_THAT(rows_of_grid(with_obstacles(std::move(grid), obstacles)),
              ElementsAreArray(Rows{"###.", "?###"}));
}

// The chair covers the middle cell, and 0.4 or 0.16 of those around it.
TEST(WithoutRims, WhatStandsByItselfGoesAsAWhole) {
  const Rows rows{"#######",  //
                  ".......",
                  ".......",
                  "..###..",
                  "..###..",
                  "..###..",
                  "......."};
  const std::vector<Polygon> chair{box_between(2.6, 1.6, 4.4, 3.4)};
  EXPECT_THAT(rows_of_grid(without_obstacles(drawn_plan(rows), chair)),
              ElementsAreArray(Rows{
                  "#######", ".......", ".......", "..###..", "..#.#..", "..###..", "......."}));
  EXPECT_THAT(cleared(rows, chair),
              ElementsAreArray(Rows{
                  "#######", ".......", ".......", ".......", ".......", ".......", "......."}));
}

// The sofa reaches 0.2 m into the wall, behind which nobody looked. Its rim goes but for the cells
// at the wall, which may be the wall's own.
TEST(WithoutRims, TheWallBehindAnObstacleStays) {
  const Rows rows{"???????",  //
                  "#######",
                  ".#####.",
                  ".#####.",
                  ".#####.",
                  ".......",
                  "......."};
  const std::vector<Polygon> sofa{box_between(1.6, 2.6, 5.4, 5.2)};
  EXPECT_THAT(cleared(rows, sofa),
              ElementsAreArray(Rows{
                  "???????", "#######", ".#...#.", ".......", ".......", ".......", "......."}));
}

// One cell beside the chair and one farther away that no shape meets: the first one belongs to it.
TEST(WithoutRims, CrumbsBesideAnObstacleGoOthersStay) {
  const Rows rows{"........",  //
                  ".###....",
                  ".####.#.",
                  ".###....",
                  "........"};
  const std::vector<Polygon> chair{box_between(1.6, 1.6, 3.4, 3.4)};
  EXPECT_THAT(cleared(rows, chair),
              ElementsAreArray(Rows{"........", "........", "......#.", "........", "........"}));
}

TEST(WithoutRims, WithoutObstaclesTheGridIsAsItWas) {
  const Rows rows{"#?.#", "...."};
  EXPECT_THAT(cleared(rows, {}), ElementsAreArray(rows));
  EXPECT_EQ(without_rims({}, {}), OccupancyGrid{});
}

}  // namespace
}  // namespace hypermap

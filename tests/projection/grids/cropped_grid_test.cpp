// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/cropped_grid.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

// 3 x 2 cells of 1 m from (10, 20): the centres are at x 10.5, 11.5, 12.5 and y 20.5, 21.5.
OccupancyGrid six_cells(double yaw_rad) {
  return OccupancyGrid::create(
             {.resolution_m = 1.0, .origin = {10, 20}, .yaw_rad = yaw_rad, .cols = 3, .rows = 2},
             {0, 100, 7, 100, 0, -1})
      .value();
}

TEST(CroppedGrid, HoldsTheCellsInsideWhereTheyWere) {
  const OccupancyGrid part = cropped(
      six_cells(0.0), [](const Eigen::Vector2d& at) { return at.x() > 11.0 && at.y() < 21.0; });
  EXPECT_EQ(part.geometry(),
            (GridGeometry{.resolution_m = 1.0, .origin = {11, 20}, .cols = 2, .rows = 1}));
  EXPECT_EQ(std::vector<std::int8_t>(part.cells().begin(), part.cells().end()),
            (std::vector<std::int8_t>{100, 7}));
}

TEST(CroppedGrid, IsUnknownWhereACellBetweenOthersIsOutside) {
  const OccupancyGrid part = cropped(six_cells(0.0), [](const Eigen::Vector2d& at) {
    return (at.x() < 11.0) == (at.y() < 21.0);  // the first of the first row, two of the second
  });
  EXPECT_EQ(std::vector<std::int8_t>(part.cells().begin(), part.cells().end()),
            (std::vector<std::int8_t>{0, -1, -1, -1, 0, -1}));
}

TEST(CroppedGrid, GivesAtEachPointWhatTheWholeSaysThere) {
  const OccupancyGrid whole = six_cells(0.3);
  const auto is_inside = [](const Eigen::Vector2d& at) { return at.x() > 10.9; };
  const OccupancyGrid part = cropped(whole, is_inside);
  int num_inside = 0;
  for (int row = 0; row < 2; ++row) {
    for (int col = 0; col < 3; ++col) {
      const Eigen::Vector2d at = centre(whole.geometry(), {.col = col, .row = row});
      if (!is_inside(at)) continue;
      EXPECT_EQ(part.at_point(at), whole.at_point(at));
      ++num_inside;
    }
  }
  EXPECT_GT(num_inside, 1);
}

TEST(CroppedGrid, OfNoCellIsOneUnknownCell) {
  const OccupancyGrid part = cropped(six_cells(0.3), [](const Eigen::Vector2d&) { return false; });
  EXPECT_EQ(part.geometry().origin, six_cells(0.3).geometry().origin);
  EXPECT_EQ(part.geometry().num_cells(), 1U);
  EXPECT_EQ(part.at({.col = 0, .row = 0}), kUnknownCell);
  EXPECT_EQ(cropped(OccupancyGrid(), [](const Eigen::Vector2d&) { return true; }), OccupancyGrid());
}

// The area meets the interiors of the first two cells of the first row, and touches the edges of
// those around: from x = 10.9 to 12 and y = 20 to 21.
TEST(SubMap, HoldsTheCellsWhoseInteriorTheAreaMeets) {
  const auto part =
      sub_map(six_cells(0.0), make_polygon({{10.9, 20}, {12, 20}, {12, 21}, {10.9, 21}}).value());
  ASSERT_TRUE(part);
  EXPECT_EQ(part->geometry(),
            (GridGeometry{.resolution_m = 1.0, .origin = {10, 20}, .cols = 2, .rows = 1}));
  EXPECT_EQ(std::vector<std::int8_t>(part->cells().begin(), part->cells().end()),
            (std::vector<std::int8_t>{0, 100}));
}

// The hypotenuse leaves the first row at (11, 21), so of the second row it meets the first cell.
TEST(SubMap, IsUnknownWhereTheAreaMeetsNoCell) {
  const auto part = sub_map(six_cells(0.0), make_polygon({{9, 20}, {13, 20}, {9, 22}}).value());
  ASSERT_TRUE(part);
  EXPECT_EQ(std::vector<std::int8_t>(part->cells().begin(), part->cells().end()),
            (std::vector<std::int8_t>{0, 100, 7, 100, -1, -1}));
}

TEST(SubMap, OfAnAreaBesideTheGridIsNone) {
  EXPECT_FALSE(sub_map(six_cells(0.2), make_polygon({{0, 0}, {1, 0}, {1, 1}}).value()));
  EXPECT_FALSE(sub_map(six_cells(0.0), make_polygon({{9, 20}, {10, 20}, {10, 21}}).value()));
}

}  // namespace
}  // namespace hypermap

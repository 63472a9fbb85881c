// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/grid_geometry.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

namespace hypermap {
namespace {

using CellMap = std::map<Cell, double>;

CellMap covered(const GridGeometry& geometry, const Polygon& polygon) {
  CellMap cells;
  std::vector<Cell> order;
  for_each_covered_cell(geometry, polygon, [&](Cell cell, double part) {
    EXPECT_TRUE(geometry.contains(cell));
    EXPECT_TRUE(cells.emplace(cell, part).second) << "visited twice";
    if (!order.empty()) {
      EXPECT_LT(std::pair(order.back().row, order.back().col), std::pair(cell.row, cell.col));
    }
    order.push_back(cell);
  });
  return cells;
}

Polygon polygon(Ring outer, std::vector<Ring> holes = {}) {
  return *make_polygon(std::move(outer), std::move(holes));
}

double sum(const CellMap& cells) {
  double total = 0.0;
  for (const auto& [cell, part] : cells) total += part;
  return total;
}

GridGeometry grid(int cols, int rows, double resolution = 1.0) {
  return {.resolution_m = resolution, .cols = cols, .rows = rows};
}

TEST(GridGeometry, APointIsFoundAsTheTextSays) {
  // [hypermap] 3.3.3: origin (1, 2), yaw 90 degrees, 0.5 m cells. The point (0.2, 3.1) lies at
  // (-0.8, 1.1) from the origin; turned back by 90 degrees: (1.1, 0.8); cells: (2.2, 1.6) -> (2,
  // 1).
  const GridGeometry geometry{
      .resolution_m = 0.5, .origin = {1, 2}, .yaw_rad = std::numbers::pi / 2, .cols = 4, .rows = 4};
  EXPECT_EQ(cell_at(geometry, {0.2, 3.1}), (Cell{2, 1}));
  // Centre of (2, 1) is (2.5, 1.5) cells = (1.25, 0.75) m, turned: (-0.75, 1.25).
  EXPECT_TRUE(centre(geometry, {2, 1}).isApprox(Eigen::Vector2d(0.25, 3.25), 1e-12));
}

TEST(GridGeometry, EdgesBelongToTheCellAboveAndRight) {
  const GridGeometry geometry = grid(2, 2);
  EXPECT_EQ(cell_at(geometry, {0, 0}), (Cell{0, 0}));
  EXPECT_EQ(cell_at(geometry, {1, 0.5}), (Cell{1, 0}));
  EXPECT_FALSE(cell_at(geometry, {2, 1}));
  EXPECT_FALSE(cell_at(geometry, {-1e-12, 1}));
  EXPECT_FALSE(cell_at(geometry, {std::nan(""), 1}));
  EXPECT_FALSE(cell_at(geometry, {1e300, 1}));
  EXPECT_FALSE(cell_at(GridGeometry{}, {0, 0}));
}

TEST(GridGeometry, CentresAreFoundAgainAtAnyYaw) {
  for (const double yaw : {0.0, 0.3, 1.0, -2.5, 3.1}) {
    const GridGeometry geometry{
        .resolution_m = 0.05, .origin = {-8, -20.8}, .yaw_rad = yaw, .cols = 32, .rows = 57};
    for (int row = 0; row < geometry.rows; row += 7) {
      for (int col = 0; col < geometry.cols; col += 5) {
        EXPECT_EQ(cell_at(geometry, centre(geometry, {col, row})), (Cell{col, row}));
      }
    }
  }
}

TEST(GridGeometry, BoundsHoldTheTurnedGrid) {
  // A 2 x 1 m grid turned by 90 degrees about (0, 0) spans x in [-1, 0], y in [0, 2].
  const GridGeometry geometry{
      .resolution_m = 1.0, .yaw_rad = std::numbers::pi / 2, .cols = 2, .rows = 1};
  EXPECT_TRUE(bounds(geometry).min.isApprox(Eigen::Vector2d(-1, 0), 1e-12));
  EXPECT_TRUE(bounds(geometry).max.isApprox(Eigen::Vector2d(0, 2), 1e-12));
}

TEST(GridGeometry, WhatIsNoGridIsRefused) {
  EXPECT_TRUE(validate(GridGeometry{}));
  for (const double resolution : {0.0, -0.05, 1e-7, 1001.0, std::nan(""), HUGE_VAL}) {
    EXPECT_FALSE(validate(grid(1, 1, resolution))) << resolution;
  }
  EXPECT_TRUE(validate(grid(1, 1, 1e-6)));
  EXPECT_TRUE(validate(grid(1, 1, 1e3)));
  EXPECT_FALSE(validate(grid(-1, 1)));
  EXPECT_EQ(validate(grid(65'536, 1)).error().code, ErrorCode::kLimit);
  EXPECT_EQ(validate(grid(65'535, 65'535)).error().code, ErrorCode::kLimit);
  EXPECT_FALSE(validate({.origin = {1e18, 0}}));
  EXPECT_FALSE(validate({.yaw_rad = std::nan("")}));
}

TEST(PolygonCoverage, AnAlignedRectangleCoversItsCellsAndNoOthers) {
  const CellMap cells = covered(grid(5, 5), polygon({{1, 1}, {3, 1}, {3, 2}, {1, 2}}));
  EXPECT_EQ(cells, (CellMap{{{1, 1}, 1.0}, {{2, 1}, 1.0}}));
}

TEST(PolygonCoverage, PartsOfCellsAreMeasured) {
  // A triangle of area 0.5 in one cell, and one that covers half of each of four cells' square.
  EXPECT_NEAR(covered(grid(3, 3), polygon({{1, 1}, {2, 1}, {2, 2}})).at({1, 1}), 0.5, 1e-12);
  const CellMap diamond = covered(grid(2, 2), polygon({{1, 0}, {2, 1}, {1, 2}, {0, 1}}));
  ASSERT_EQ(diamond.size(), 4U);
  for (const auto& [cell, part] : diamond) EXPECT_NEAR(part, 0.5, 1e-12);
}

TEST(PolygonCoverage, AHoleIsLeftOut) {
  const Polygon ring =
      polygon({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{{1, 1}, {2, 1}, {2, 2}, {1, 2}}});
  const CellMap cells = covered(grid(3, 3), ring);
  EXPECT_EQ(cells.size(), 8U);
  EXPECT_FALSE(cells.contains({1, 1}));
}

TEST(PolygonCoverage, WhatLiesOutsideIsLeftOut) {
  const Polygon big = polygon({{-10, -10}, {20, -10}, {20, 20}, {-10, 20}});
  EXPECT_NEAR(sum(covered(grid(4, 3), big)), 12.0, 1e-12);
  EXPECT_TRUE(covered(grid(4, 3), polygon({{5, 0}, {6, 0}, {6, 1}})).empty());
  EXPECT_TRUE(covered(grid(4, 3), polygon({{-5, 0}, {-4, 0}, {-4, 1}})).empty());
  EXPECT_TRUE(covered(grid(4, 3), polygon({{0, 7}, {1, 7}, {1, 8}})).empty());
  EXPECT_TRUE(covered(grid(0, 0), big).empty());
}

TEST(PolygonCoverage, ANeedleThinnerThanACellIsNotLost) {
  const CellMap cells =
      covered(grid(10, 3), polygon({{0.5, 1.4}, {9.5, 1.4}, {9.5, 1.401}, {0.5, 1.401}}));
  EXPECT_EQ(cells.size(), 10U);
  EXPECT_NEAR(sum(cells), 9 * 0.001, 1e-12);
}

/// Brute force: the part of a cell's raster of points that lies inside.
double sampled(const GridGeometry& geometry, const Polygon& shape, Cell cell) {
  constexpr int kSteps = 40;
  int inside = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const Eigen::Vector2d cells(cell.col + (i + 0.5) / kSteps, cell.row + (j + 0.5) / kSteps);
      inside += contains(shape, from_cells(geometry, cells)) ? 1 : 0;
    }
  }
  return inside / static_cast<double>(kSteps * kSteps);
}

TEST(PolygonCoverage, ATurnedGridAgreesWithSampling) {
  const GridGeometry geometry{
      .resolution_m = 0.3, .origin = {-1.2, 0.4}, .yaw_rad = 0.7, .cols = 9, .rows = 8};
  const Polygon shape = polygon({{-2, 1}, {0.3, 0.6}, {0.9, 2.2}, {-0.1, 1.7}, {-1.1, 3.2}},
                                {{{-0.8, 1.3}, {-0.2, 1.2}, {-0.5, 1.6}}});
  const CellMap cells = covered(geometry, shape);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const auto found = cells.find({col, row});
      const double part = found == cells.end() ? 0.0 : found->second;
      EXPECT_NEAR(part, sampled(geometry, shape, {col, row}), 0.03) << col << " " << row;
    }
  }
}

TEST(PolygonCoverage, TheSumOverAllCellsIsTheArea) {
  const GridGeometry geometry{
      .resolution_m = 0.05, .origin = {-3, -3}, .yaw_rad = 0.31, .cols = 200, .rows = 200};
  Ring ring;
  for (int i = 0; i < 97; ++i) {
    const double angle = i * 2 * std::numbers::pi / 97;
    const double radius = 1.0 + 0.4 * std::sin(7 * angle);
    ring.emplace_back(0.5 + radius * std::cos(angle), 1.5 + radius * std::sin(angle));
  }
  const Polygon star = polygon(ring);
  EXPECT_NEAR(sum(covered(geometry, star)) * 0.05 * 0.05, area_m2(star), 1e-9);
}

}  // namespace
}  // namespace hypermap

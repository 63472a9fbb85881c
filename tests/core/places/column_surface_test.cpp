// SPDX-License-Identifier: BSD-3-Clause
#include "places/column_surface.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

TEST(ColumnSurface, KeepsTheLowestAndTheHighestPointOfEachSquare) {
  const std::vector<Eigen::Vector3d> points{
      {0.31, -0.01, 0.5}, {0.02, 0.02, 1.0}, {0.03, 0.07, 3.0}, {0.04, 0.04, 2.0}};
  const ColumnSurface surface(points, 0.1);
  ASSERT_EQ(surface.columns().size(), 2U);
  EXPECT_EQ(surface.columns()[0], (Column{.x = 0, .y = 0, .bottom_m = 1.0, .top_m = 3.0}));
  EXPECT_EQ(surface.columns()[1], (Column{.x = 3, .y = -1, .bottom_m = 0.5, .top_m = 0.5}));
  ASSERT_NE(surface.find(3, -1), nullptr);
  EXPECT_EQ(surface.find(3, 0), nullptr);
  EXPECT_TRUE(ColumnSurface().empty());
}

TEST(ColumnSurface, FindsTheColumnsInAndAroundAPolygon) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(10);
  for (int i = 0; i < 10; ++i) points.emplace_back(0.1 * i + 0.05, 0.05, 1.0);
  const ColumnSurface surface(points, 0.1);
  const Polygon square = make_polygon({{0.3, 0.0}, {0.6, 0.0}, {0.6, 0.1}, {0.3, 0.1}}).value();
  EXPECT_EQ(surface.within(square, 0.0).size(), 3U);   // middles 0.35, 0.45, 0.55
  EXPECT_EQ(surface.within(square, 0.06).size(), 5U);  // and 0.25, 0.65
}

TEST(ColumnSurface, AHeightThatAShareReaches) {
  std::vector<Eigen::Vector3d> points;
  points.reserve(10);
  for (int i = 0; i < 10; ++i) points.emplace_back(i, 0, 0.1 * i);
  const ColumnSurface surface(points, 0.5);
  EXPECT_DOUBLE_EQ(surface.height_reached_by(0.1), 0.9);
  EXPECT_DOUBLE_EQ(surface.height_reached_by(0.11), 0.8);
  EXPECT_DOUBLE_EQ(surface.height_reached_by(1.0), 0.0);
}

TEST(LowerMedian, OfAnEvenNumberIsTheLower) {
  EXPECT_DOUBLE_EQ(lower_median({3.0, 1.0, 2.0}), 2.0);
  EXPECT_DOUBLE_EQ(lower_median({4.0, 1.0, 3.0, 2.0}), 2.0);
}

}  // namespace
}  // namespace hypermap

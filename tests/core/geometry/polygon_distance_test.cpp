// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(Distance, FromAPointAndBetweenPolygons) {
  const Polygon square =
      make_polygon({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{{1, 1}, {3, 1}, {3, 3}, {1, 3}}}).value();
  EXPECT_DOUBLE_EQ(distance_m(square, Eigen::Vector2d(7, 8)), 5.0);  // corner (4, 4): 3, 4, 5
  EXPECT_DOUBLE_EQ(distance_m(square, Eigen::Vector2d(4, 2)), 0.0);
  EXPECT_DOUBLE_EQ(distance_m(square, Eigen::Vector2d(2, 2.5)), 0.5);  // in the hole
  const Polygon beside = make_polygon({{6, 1}, {8, 2}, {6, 3}}).value();
  EXPECT_DOUBLE_EQ(distance_m(square, beside), 2.0);
  EXPECT_DOUBLE_EQ(distance_m(beside, square), 2.0);
  const Polygon inside = make_polygon({{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}}).value();
  EXPECT_DOUBLE_EQ(distance_m(square, inside), 0.5);
  EXPECT_DOUBLE_EQ(distance_m(square, translated(square, {2, 2})), 0.0);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon_motion.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

/// A quarter turn to the left, then 10 along x and 20 along y: (x, y) becomes (10 - y, 20 + x).
Eigen::Isometry2d turned_and_shifted() {
  Eigen::Isometry2d to_from = Eigen::Isometry2d::Identity();
  to_from.linear() << 0, -1, 1, 0;
  to_from.translation() = Eigen::Vector2d(10, 20);
  return to_from;
}

TEST(PolygonMotion, MovesEachCornerAndThoseOfHoles) {
  const Polygon square{.outer = {{0, 0}, {4, 0}, {4, 3}, {0, 3}},
                       .holes = {{{1, 1}, {1, 2}, {2, 2}, {2, 1}}}};
  const Polygon there = moved(square, turned_and_shifted());
  EXPECT_EQ(there.outer, (Ring{{10, 20}, {10, 24}, {7, 24}, {7, 20}}));
  ASSERT_EQ(there.holes.size(), 1U);
  EXPECT_EQ(there.holes[0], (Ring{{9, 21}, {8, 21}, {8, 22}, {9, 22}}));
  EXPECT_EQ(area_m2(there), area_m2(square));
  EXPECT_EQ(moved(there, turned_and_shifted().inverse()).outer, square.outer);
}

TEST(PolygonMotion, NothingStaysNothing) {
  EXPECT_TRUE(moved(Polygon{}, turned_and_shifted()).outer.empty());
}

}  // namespace
}  // namespace hypermap

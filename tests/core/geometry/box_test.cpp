// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/box.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace hypermap {
namespace {

// [smap] pseudocode 3.2: the smallest and the largest coordinate on each axis.
TEST(BoundingBox, TakesTheExtremesOfEachAxis) {
  const std::vector<Eigen::Vector3f> points{{1, 5, -1}, {0, 7, 2}, {3, 6, 0}};
  const Box box = bounding_box(points);
  EXPECT_EQ(box.min_in_map, Eigen::Vector3d(0, 5, -1));
  EXPECT_EQ(box.max_in_map, Eigen::Vector3d(3, 7, 2));
  EXPECT_EQ(box.centre(), Eigen::Vector3d(1.5, 6, 0.5));  // centroid = (min + max) / 2
}

TEST(BoundingBox, OfOnePointHasNoVolume) {
  const std::vector<Eigen::Vector3f> points{{1, 2, 3}};
  EXPECT_EQ(bounding_box(points).volume_m3(), 0.0);
}

TEST(Box, FacesBelongToTheBox) {
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(box.contains({1, 1, 1}));
  EXPECT_FALSE(box.contains({1.001, 1, 1}));
  EXPECT_TRUE(box.intersects({{1, 0, 0}, {2, 1, 1}}));
  EXPECT_FALSE(box.intersects({{1.001, 0, 0}, {2, 1, 1}}));
}

TEST(Box, HasEightDifferentCornersOnItself) {
  const Box box{{0, 1, 2}, {3, 5, 9}};
  std::set<std::vector<double>> seen;
  for (const Eigen::Vector3d& corner : box.corners()) {
    EXPECT_TRUE(box.contains(corner));
    seen.insert({corner.x(), corner.y(), corner.z()});
  }
  EXPECT_EQ(seen.size(), 8U);
}

TEST(BoundingBox, OfTwoBoxesReachesAsFarAsEither) {
  const Box a{{0, 1, 2}, {3, 5, 9}};
  const Box b{{1, -1, 2}, {4, 2, 3}};
  EXPECT_EQ(bounding_box(a, b), (Box{{0, -1, 2}, {4, 5, 9}}));
  EXPECT_EQ(bounding_box(b, a), bounding_box(a, b));
}

// Intersection 1 x 2 x 2 = 4; union 8 + 8 - 4 = 12; 4 / 12.
TEST(IntersectionOverUnion, MatchesAHandWorkedPair) {
  EXPECT_DOUBLE_EQ(intersection_over_union({{0, 0, 0}, {2, 2, 2}}, {{1, 0, 0}, {3, 2, 2}}),
                   4.0 / 12.0);
}

TEST(IntersectionOverUnion, IsZeroForApartTouchingAndFlatBoxes) {
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(intersection_over_union(unit, {{2, 2, 2}, {3, 3, 3}}), 0.0);
  EXPECT_EQ(intersection_over_union(unit, {{1, 0, 0}, {2, 1, 1}}), 0.0);
  EXPECT_EQ(intersection_over_union({{0, 0, 0}, {1, 1, 0}}, {{0, 0, 0}, {1, 1, 0}}), 0.0);
  EXPECT_EQ(intersection_over_union(unit, unit), 1.0);
}

}  // namespace
}  // namespace hypermap

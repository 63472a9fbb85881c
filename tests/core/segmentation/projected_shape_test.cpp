// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/projected_shape.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

/// The upper half of a box of 0.4 x 0.2 m, as a camera sees it, 1 cm apart.
std::vector<Eigen::Vector3f> box_surface() {
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 40; ++i) {
    for (int k = 0; k <= 20; ++k) {
      const auto x = 1.0F + 0.01F * static_cast<float>(i);
      points.emplace_back(x, 2.0F, 0.01F * static_cast<float>(k));
      points.emplace_back(x, 2.0F + 0.01F * static_cast<float>(k), 0.2F);
    }
  }
  return points;
}

// [hypermap] 3.4.4: projected to the floor, the hull of the box is its footprint, 0.08 m2.
TEST(ProjectedHull, IsTheFootprintOfTheSurface) {
  const Polygon hull = projected_hull(box_surface(), 0.0).value();
  EXPECT_NEAR(area_m2(hull), 0.08, 1e-6);
  EXPECT_TRUE(centroid(hull).isApprox(Eigen::Vector2d(1.2, 2.1), 1e-5));
}

TEST(ProjectedHull, OfThinnedPointsIsSmallerByTheCellsAtItsEdges) {
  const double area = area_m2(projected_hull(box_surface(), 0.05).value());
  EXPECT_LT(area, 0.08);
  EXPECT_GT(area, 0.35 * 0.15);  // each side loses less than half a cell
}

TEST(ProjectedHull, RefusesPointsThatSpanNoArea) {
  const std::vector<Eigen::Vector3f> upright{{1, 1, 0}, {1, 1, 1}, {1, 1, 2}};
  EXPECT_EQ(projected_hull(upright, 0.0).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(projected_hull({}, 0.0).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(projected_hull(box_surface(), -0.1).error().field, "leaf_size_m");
}

}  // namespace
}  // namespace hypermap

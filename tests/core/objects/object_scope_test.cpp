// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_scope.hpp"

#include "support/camera_pose.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hypermap {
namespace {

/// 101 x 61 pixels around the axis, the corners 50 and 30 pixels off it.
RgbdFrame frame_ahead() {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 101, .height_px = 61, .fx_px = 50, .fy_px = 30, .cx_px = 50, .cy_px = 30};
  frame.map_from_camera = test::camera_at({1, 2, 3}, 0.0, 0.0);
  frame.depth_m = DepthImage(101, 61, 1.0F);
  return frame;
}

// [smap] figure 3.5 with table D.1: R_min = 0.2, R_max = 1.7. Corners lie at (1, 1) for a depth of
// 1: the cone opens by atan(sqrt(2)) to each side.
TEST(ActiveCone, IsAsWideAsTheImageBetweenTwoDepths) {
  const ActiveCone cone = active_cone(frame_ahead(), 0.2, 1.7);
  EXPECT_EQ(cone.apex.xyz, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(cone.axis_in_map.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(cone.half_angle_rad, std::atan(std::sqrt(2.0)), 1e-12);
  EXPECT_TRUE(cone.contains({2, 2, 3}));
  EXPECT_TRUE(cone.contains({2, 3.41, 3})) << "1.41 beside 1 ahead is inside,";
  EXPECT_FALSE(cone.contains({2, 3.42, 3})) << "1.42 is not";
  EXPECT_TRUE(cone.contains({2.69, 3.5, 3})) << "1.69 along the axis, though 2.3 away";
  EXPECT_FALSE(cone.contains({2.71, 2, 3}));
  EXPECT_TRUE(cone.contains({1.21, 2, 3}));
  EXPECT_FALSE(cone.contains({1.19, 2, 3}));
  EXPECT_FALSE(cone.contains({0, 2, 3})) << "behind";
}

TEST(ObjectScope, AsksForEverythingThatIsGiven) {
  const ActiveCone cone = active_cone(frame_ahead(), 0.2, 1.7);
  const Eigen::Vector3d ahead(2, 2, 3);
  const Eigen::Vector3d behind(0, 2, 3);
  const auto is_low = [](const Eigen::Vector3d& centroid) { return centroid.z() < 3.5; };
  const auto is_high = [](const Eigen::Vector3d& centroid) { return centroid.z() > 3.5; };
  EXPECT_TRUE(ObjectScope{}.contains(behind));
  EXPECT_TRUE(ObjectScope{.is_near = is_low}.contains(behind));
  EXPECT_FALSE(ObjectScope{.is_near = is_high}.contains(ahead));
  EXPECT_TRUE(ObjectScope{.cone = cone}.contains(ahead));
  EXPECT_FALSE(ObjectScope{.cone = cone}.contains(behind));
  EXPECT_FALSE((ObjectScope{.is_near = is_high, .cone = cone}.contains(ahead)));
  EXPECT_FALSE((ObjectScope{.is_near = is_low, .cone = cone}.contains(behind)));
  EXPECT_TRUE((ObjectScope{.is_near = is_low, .cone = cone}.contains(ahead)));
}

}  // namespace
}  // namespace hypermap

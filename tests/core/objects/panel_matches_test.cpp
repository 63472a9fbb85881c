// SPDX-License-Identifier: BSD-3-Clause
#include "objects/evidence/panel_matches.hpp"

#include "support/camera_pose.hpp"
#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

constexpr double kPanelDegree = std::numbers::pi / 180.0;
constexpr double kRightAngle = std::numbers::pi / 2.0;

TEST(PanelAngles, AreThoseFromTheHeadingAndTheHeightOfTheCamera) {
  // [smap] Eq. (3.24), (3.25): a camera at (1, 1, 1) that looks along +y, theta = 90 degrees. The
  // point 2 m ahead and 2 m up: atan2(2, 0) - 90 = 0; as printed atan2(-2, 0) - 90 = 180 degrees.
  const Eigen::Vector3d camera(1, 1, 1);
  const SphericalAngles ahead = angles_from_camera({1, 3, 3}, camera, kRightAngle);
  EXPECT_NEAR(ahead.azimuth_rad, 0.0, 1e-12);
  EXPECT_NEAR(ahead.elevation_rad, 45.0 * kPanelDegree, 1e-12);
  const SphericalAngles left = angles_from_camera({0, 1, 0}, camera, kRightAngle);
  EXPECT_NEAR(left.azimuth_rad, 90.0 * kPanelDegree, 1e-12);
  EXPECT_NEAR(left.elevation_rad, -45.0 * kPanelDegree, 1e-12);
  // Behind it to the left: atan2(-1, -0.1) - 90 is below -180 degrees and comes round.
  EXPECT_NEAR(angles_from_camera({0.9, 0, 1}, camera, kRightAngle).azimuth_rad,
              std::atan2(-1.0, -0.1) + 3.0 * kRightAngle,
              1e-12);
}

TEST(PanelAngles, DifferTheShortWayRound) {
  // [smap] Eq. (3.22), (3.23): 170 and -170 degrees are 20 apart; 3 and 4 degrees make 5.
  EXPECT_NEAR(angular_distance_rad({170.0 * kPanelDegree, 0.0}, {-170.0 * kPanelDegree, 0.0}),
              20.0 * kPanelDegree,
              1e-12);
  EXPECT_NEAR(
      angular_distance_rad({3.0 * kPanelDegree, 14.0 * kPanelDegree}, {0.0, 10.0 * kPanelDegree}),
      5.0 * kPanelDegree,
      1e-12);
}

/// 24 x 16 panels of 10 x 10 pixels; the camera at the origin looks along +x. The columns left of
/// `split_column` measure `left_m`, the others `right_m`; 0 is nothing.
BinnedDepthMap split_wall(double left_m, double right_m, int split_column = 12) {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 240, .height_px = 160, .fx_px = 200, .fy_px = 200, .cx_px = 119.5, .cy_px = 79.5};
  frame.map_from_camera = test::camera_at({0, 0, 0}, 0.0, 0.0);
  frame.depth_m = DepthImage(240, 160, static_cast<float>(left_m));
  for (int v = 0; v < 160; ++v) {
    for (int u = 10 * split_column; u < 240; ++u) {
      frame.depth_m.at(u, v) = static_cast<float>(right_m);
    }
  }
  return BinnedDepthMap::create(frame);
}

PanelCounts counts_of(const BinnedDepthMap& depth, const Box& box) {
  return PanelMatches(depth).count(box, 0.1);
}

// [smap] figure 3.24. A flat box 2 m ahead, 0.38 m wide and high: its corners are 19 pixels off the
// middle, in the columns 10 and 13 and the rows 6 and 9: 4 x 4 panels.
const Box kPlate = testing_support::box_at({2, 0, 0}, {0.02, 0.38, 0.38});

TEST(PanelMatches, CountWhatLiesBeforeInsideAndAfterTheBox) {
  EXPECT_EQ(counts_of(split_wall(1.0, 1.0), kPlate), (PanelCounts{.before = 16}));
  EXPECT_EQ(counts_of(split_wall(2.0, 2.0), kPlate), (PanelCounts{.inside = 16}));
  EXPECT_EQ(counts_of(split_wall(3.0, 3.0), kPlate), (PanelCounts{.after = 16}));
  EXPECT_EQ(counts_of(split_wall(1.0, 3.0), kPlate), (PanelCounts{.before = 8, .after = 8}));
  EXPECT_EQ(counts_of(split_wall(2.0, 3.0, 13), kPlate), (PanelCounts{.inside = 12, .after = 4}));
}

TEST(PanelMatches, TheToleranceReachesBothWays) {
  // The nearest point is 1.99 m away, the farthest one hypot(2.01, 0.19, 0.19) = 2.0279 m.
  EXPECT_EQ(counts_of(split_wall(1.91, 1.91), kPlate).inside, 16);
  EXPECT_EQ(counts_of(split_wall(1.87, 1.87), kPlate).before, 16);
  EXPECT_EQ(counts_of(split_wall(2.10, 2.10), kPlate).inside, 16);
  EXPECT_EQ(counts_of(split_wall(2.14, 2.14), kPlate).after, 16);
}

TEST(PanelMatches, CornersOutOfTheImageTakeThePanelsAtItsEdge) {
  // To the right of the image all corners take panels of the last column, which is at 4.9 m; to
  // the left of it of the first one, at 1 m. Half of the box out of it: the columns from 22 on.
  const BinnedDepthMap depth = split_wall(1.0, 4.9, 23);
  const PanelCounts right =
      counts_of(depth, testing_support::box_at({2, -3, 0}, {0.02, 0.38, 0.38}));
  EXPECT_EQ(right, (PanelCounts{.after = right.all()}));
  EXPECT_GT(right.all(), 0);
  const PanelCounts left = counts_of(depth, testing_support::box_at({2, 3, 0}, {0.02, 0.38, 0.38}));
  EXPECT_EQ(left, (PanelCounts{.before = left.all()}));
  EXPECT_GT(left.all(), 0);
  const PanelCounts half =
      counts_of(depth, testing_support::box_at({2, -1.2, 0}, {0.02, 0.38, 0.38}));
  EXPECT_EQ(half.before, half.after) << "as many panels in column 22 as in column 23";
  EXPECT_GT(half.after, 0);
}

TEST(PanelMatches, PanelsWithoutAPointAreNone) {
  EXPECT_EQ(counts_of(split_wall(0.0, 0.0), kPlate), PanelCounts{});
  EXPECT_EQ(counts_of(split_wall(0.0, 3.0), kPlate), (PanelCounts{.after = 8}));
}

}  // namespace
}  // namespace hypermap

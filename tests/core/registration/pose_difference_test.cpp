// SPDX-License-Identifier: BSD-3-Clause
#include "registration/pose_difference.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

constexpr PoseRefinementOptions kOptions{.rule = PoseRefinementRule::kPointToPlane};

Eigen::Isometry3d pose_of(const Eigen::Vector3d& turn_rad, const Eigen::Vector3d& place_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (turn_rad.norm() > 0.0) {
    pose.linear() = Eigen::AngleAxisd(turn_rad.norm(), turn_rad.normalized()).toRotationMatrix();
  }
  pose.translation() = place_m;
  return pose;
}

TEST(PoseDifference, OneFrameIsBroughtOntoItsGivenPose) {
  const Eigen::Isometry3d given = pose_of({0.3, -0.4, 1.2}, {2, -1, 1.4});
  const Eigen::Isometry3d pose = pose_of({0.0, 0.0, 1e-3}, {0.002, 0.001, 0}) * given;
  const Eigen::Isometry3d mended = motion_of(difference(given, pose, kOptions)) * pose;
  // What is left is of second order.
  EXPECT_TRUE(mended.isApprox(given, 1e-5));
  EXPECT_FALSE(pose.isApprox(given, 1e-4));
}

TEST(PoseDifference, TwoFramesMeetInTheMiddle) {
  // Given 2 cm to either side of where they are: no motion mends both.
  PoseDifference sum;
  for (const double side_m : {-0.02, 0.02}) {
    const PoseDifference one =
        difference(pose_of({0, 0, 0}, {side_m, 0, 0}), pose_of({0, 0, 0}, {0, 0, 0}), kOptions);
    sum.information += one.information;
    sum.gradient += one.gradient;
  }
  EXPECT_TRUE(motion_of(sum).isApprox(Eigen::Isometry3d::Identity(), 1e-12));
}

TEST(PoseDifference, PlacesTellATurnThatOrientationsDeny) {
  // Ten metres apart, the places say a turn of 1 mrad more surely than the orientations, of 8.7
  // mrad each, say none: 0.01 m / 5 m = 2 mrad each.
  PoseDifference sum;
  for (const double x_m : {-5.0, 5.0}) {
    const Eigen::Isometry3d pose = pose_of({0, 0, 0}, {x_m, 0, 0});
    const PoseDifference one = difference(pose_of({0, 0, 0}, {x_m, 1e-3 * x_m, 0}), pose, kOptions);
    sum.information += one.information;
    sum.gradient += one.gradient;
  }
  // Weights by hand: 25 / 0.01^2 = 250,000 against 1 / 0.0087^2 = 13,212 a frame.
  const Eigen::Isometry3d motion = motion_of(sum);
  const double turn_rad = Eigen::AngleAxisd(motion.linear()).angle();
  EXPECT_NEAR(turn_rad, 1e-3 * 250'000.0 / (250'000.0 + 13'211.8), 1e-8);
}

}  // namespace
}  // namespace hypermap

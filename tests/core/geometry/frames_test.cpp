// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hypermap {
namespace {

Eigen::Isometry3d turn_and_shift() {
  Eigen::Isometry3d transform(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()));
  transform.translation() = Eigen::Vector3d(1e5, -2.0, 3.0);
  return transform;
}

TEST(Transform, ComposesFromRightToLeft) {
  const Transform<frame::Map, frame::Input> map_from_input(turn_and_shift());
  const Transform<frame::Input, frame::Camera> input_from_camera(
      Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.0)));
  const PointInCamera point{{1.0, 2.0, 3.0}};
  const MapFromCamera map_from_camera = map_from_input * input_from_camera;
  const Eigen::Vector3d by_hand = turn_and_shift() * Eigen::Vector3d(1.0, 2.0, 4.0);
  EXPECT_TRUE((map_from_camera * point).xyz.isApprox(by_hand));
  EXPECT_TRUE((map_from_camera.inverse() * PointInMap{by_hand}).xyz.isApprox(point.xyz, 1e-9));
}

// Twice the length along x: R^T R is 4 there, 3 too much.
TEST(RotationError, IsTheLargestDifferenceOfAProduct) {
  EXPECT_LT(rotation_error(turn_and_shift().linear()), 1e-14);
  EXPECT_EQ(rotation_error(Eigen::Vector3d(1.0, 1.0, -1.0).asDiagonal()), 0.0);
  EXPECT_EQ(rotation_error(Eigen::Vector3d(2.0, 1.0, 1.0).asDiagonal()), 3.0);
}

TEST(IsRigid, RefusesMirrorsStretchesAndWhatIsNotFinite) {
  EXPECT_TRUE(is_rigid(turn_and_shift(), 1e-9));
  Eigen::Isometry3d transform = turn_and_shift();
  transform.linear() *= 1.0 + 1e-6;
  EXPECT_TRUE(is_rigid(transform, 3e-6));
  EXPECT_FALSE(is_rigid(transform, 1e-6));
  transform = turn_and_shift();
  transform.linear().col(2) *= -1.0;
  EXPECT_FALSE(is_rigid(transform, 1.0)) << "a mirror";
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    transform = turn_and_shift();
    transform.translation().x() = bad;
    EXPECT_FALSE(is_rigid(transform, 1.0));
    transform = turn_and_shift();
    transform.linear()(1, 1) = bad;
    EXPECT_FALSE(is_rigid(transform, 1.0));
  }
}

}  // namespace
}  // namespace hypermap

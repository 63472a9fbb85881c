// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a camera of a test stands and looks: x to the right, y down, z forward.
#pragma once

#include "hypermap/core/geometry/frames.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace hypermap::test {

/// Requires: `forward` and `right` have length 1 and a right angle between them.
inline MapFromCamera camera_with_axes(const Eigen::Vector3d& eye,
                                      const Eigen::Vector3d& forward,
                                      const Eigen::Vector3d& right) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = right;
  pose.linear().col(1) = forward.cross(right);
  pose.linear().col(2) = forward;
  pose.translation() = eye;
  return MapFromCamera(pose);
}

/// Looks along `yaw_rad` (0: along x of the map) and `pitch_rad` up, not rolled.
inline MapFromCamera camera_at(const Eigen::Vector3d& eye, double yaw_rad, double pitch_rad) {
  const Eigen::Vector3d forward(std::cos(pitch_rad) * std::cos(yaw_rad),
                                std::cos(pitch_rad) * std::sin(yaw_rad),
                                std::sin(pitch_rad));
  return camera_with_axes(eye, forward, {std::sin(yaw_rad), -std::cos(yaw_rad), 0.0});
}

/// Looks at `target`, not rolled.
inline MapFromCamera look_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  return camera_with_axes(eye, forward, forward.cross(Eigen::Vector3d::UnitZ()).normalized());
}

}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Small rotations as vectors.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hypermap {

/// The rotation about `vector` by its length in radians.
[[nodiscard]] inline Eigen::Matrix3d rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (!(angle > 0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

/// The vector of length 0 .. pi whose rotation_of is `rotation`.
[[nodiscard]] inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

/// The matrix that crosses `a` with a vector.
[[nodiscard]] inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return matrix;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Points and rigid transforms whose frames are part of their types.
#pragma once

#include <Eigen/Geometry>

namespace hypermap {

/// Coordinate frames. Metres, right-handed; docs/CONVENTIONS.md draws them.
namespace frame {
struct Map {};     ///< Fixed world frame. +z is up. Every stored map quantity is in this frame.
struct Camera {};  ///< Depth-camera optical frame. +z forward, +x right, +y down (pinhole).
struct Input {};   ///< World frame of a dataset's trajectory, before its alignment to gravity.
}  // namespace frame

/// A point whose frame is part of its type. Unit: metre.
template <class Frame>
struct Point {
  Eigen::Vector3d xyz = Eigen::Vector3d::Zero();
};

/// Rigid transform read right to left: `map_from_camera * point_in_camera -> point in Map`.
///
/// Only transforms whose inner frames agree compose, so a wrong order does not compile.
template <class To, class From>
class Transform {
 public:
  Transform() : isometry_(Eigen::Isometry3d::Identity()) {}
  explicit Transform(const Eigen::Isometry3d& isometry) : isometry_(isometry) {}

  [[nodiscard]] Point<To> operator*(const Point<From>& p) const { return {isometry_ * p.xyz}; }

  template <class Inner>
  [[nodiscard]] Transform<To, Inner> operator*(const Transform<From, Inner>& rhs) const {
    return Transform<To, Inner>(isometry_ * rhs.isometry());
  }

  [[nodiscard]] Transform<From, To> inverse() const {
    return Transform<From, To>(isometry_.inverse());
  }

  /// Where the origin of `From` lies in `To`.
  [[nodiscard]] Point<To> origin() const { return {isometry_.translation()}; }

  /// Escape hatch for inner loops and third-party calls.
  [[nodiscard]] const Eigen::Isometry3d& isometry() const noexcept { return isometry_; }

 private:
  Eigen::Isometry3d isometry_;
};

/// How far a matrix is from one that keeps lengths: the largest entry of |R^T R - 1|. 0 for
/// rotations and mirrors. Requires: finite.
[[nodiscard]] inline double rotation_error(const Eigen::Matrix3d& matrix) {
  return (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

/// Whether it is finite, no mirror, and a rotation and shift within `max_error` (rotation_error).
[[nodiscard]] inline bool is_rigid(const Eigen::Isometry3d& transform, double max_error) {
  return transform.matrix().allFinite() && rotation_error(transform.linear()) <= max_error &&
         transform.linear().determinant() > 0.0;
}

using MapFromCamera = Transform<frame::Map, frame::Camera>;
using MapFromInput = Transform<frame::Map, frame::Input>;
using InputFromCamera = Transform<frame::Input, frame::Camera>;
using PointInMap = Point<frame::Map>;
using PointInCamera = Point<frame::Camera>;

}  // namespace hypermap

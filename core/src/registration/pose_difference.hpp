// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far frames' given poses are from those that the surfaces give, and the motion that mends it.
#pragma once

#include "hypermap/core/registration/pose_refinement.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace hypermap {

/// Normal equations of a small motion of the map, rotation about its origin, then translation: it
/// brings poses onto the given ones with the least squared error, in the options' sigmas.
struct PoseDifference {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
};

/// That of one frame; both poses are map from camera, a small rotation apart.
[[nodiscard]] PoseDifference difference(const Eigen::Isometry3d& given,
                                        const Eigen::Isometry3d& pose,
                                        const PoseRefinementOptions& options);

/// The motion that solves them. Requires: at least one frame's information.
[[nodiscard]] Eigen::Isometry3d motion_of(const PoseDifference& difference);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One frame against the surface model.
#pragma once

#include "hypermap/core/registration/pose_refinement.hpp"
#include "hypermap/core/registration/surface_model.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <span>

namespace hypermap {

struct PoseEstimate {
  Eigen::Isometry3d model_from_camera = Eigen::Isometry3d::Identity();
  PoseCorrection correction;
};

/// The most probable pose, given the points' distances from the planes of the model and that
/// `given` is right within the options' sigmas; `given` itself with the reason where that is
/// refused. Gauss-Newton on point-to-plane distances, weighted by the sensor's noise and Tukey's
/// function. Directions of which the points say next to nothing, a tenth of what the given pose
/// does, stay as given.
[[nodiscard]] PoseEstimate estimate_pose(std::span<const OrientedPoint> points_in_camera,
                                         const Eigen::Isometry3d& given,
                                         const SurfaceModel& surfaces,
                                         const PoseRefinementOptions& options);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Refines the poses of a sequence of frames, one after the other.
#pragma once

#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/registration/pose_refinement.hpp"
#include "hypermap/core/registration/surface_model.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// A frame's refined pose, and what `PoseRefiner::add` needs of the frame.
struct RefinedPose {
  MapFromCamera map_from_camera;
  PoseCorrection correction;
  Eigen::Isometry3d model_from_camera = Eigen::Isometry3d::Identity();
  std::vector<OrientedPoint> points_in_camera;  ///< Of a denser grid; metres.
};

/// Where a frame stands among the surfaces that it was added to.
struct RegisteredPose {
  Eigen::Isometry3d model_from_camera = Eigen::Isometry3d::Identity();
  std::uint32_t model = 0;  ///< Surfaces that are begun anew are another model.
};

/// Registers each frame to the surfaces of those before it, starting from its given pose.
///
/// Surfaces are kept in a frame of their own, so that they stay consistent; the map is where their
/// poses agree with the given ones on the mean. With white noise of the given poses that removes
/// what the first frame's noise would leave in the map for ever, as the root of the frames.
/// A value; everything depends on the frames alone. Scope: mends given poses; no SLAM, no loops.
class PoseRefiner {
 public:
  /// Requires: validate(options).
  explicit PoseRefiner(const PoseRefinementOptions& options);

  /// The refined pose, or the given one with the reason. Pixels in `left_out` (not zero) are no
  /// surface; an empty image leaves out none. Requires: rule not none, validate(frame).
  [[nodiscard]] RefinedPose refine(const RgbdFrame& frame, const MaskImage& left_out) const;

  /// The frame is in the map: what it showed serves the next ones. Returns where it stands among
  /// the surfaces, of which it may be the first; none where it is used as given. Requires:
  /// `refined` is of `frame` and nothing was added since.
  std::optional<RegisteredPose> add(const RgbdFrame& frame, const RefinedPose& refined);

 private:
  void follow_given(const MapFromCamera& given, const Eigen::Isometry3d& model_from_camera);

  PoseRefinementOptions options_;
  SurfaceModel surfaces_;
  Eigen::Isometry3d map_from_model_ = Eigen::Isometry3d::Identity();
  /// Of `map_from_model_`: rotation about the camera's place, then translation.
  Eigen::Matrix<double, 6, 6> information_ = Eigen::Matrix<double, 6, 6>::Zero();
  std::uint32_t model_ = 0;  ///< How often the surfaces were begun anew.
  int num_disagreeing_ = 0;  ///< Frames in a row whose surfaces were found elsewhere.
};

}  // namespace hypermap

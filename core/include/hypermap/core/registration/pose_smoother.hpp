// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Refined poses of a sequence that the frames after them have a say in, too.
#pragma once

#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/registration/pose_refinement.hpp"
#include "hypermap/core/registration/pose_refiner.hpp"

#include <cstddef>
#include <deque>
#include <optional>

namespace hypermap {

/// Where the frame stands, and what became of its given pose.
struct SmoothedPose {
  MapFromCamera map_from_camera;
  PoseCorrection correction;
};

/// Says where frames stand that can wait for those after them, as those of a recorded sequence can.
///
/// Frames that were registered to the same surfaces stand right to each other; where the surfaces
/// lie in the map, only given poses say, each with its error. PoseRefiner takes the mean of the
/// differences over the frames before. Here it is a mean over the frames on both sides, weighted by
/// (1 - 1 / window_frames) to the power of how many frames they are apart: up to half the
/// variance that the given poses' noise leaves, and less lag behind surfaces that drift.
///
/// A value. Memory: some hundred bytes a frame that waits, and for the 4 window_frames before it.
class PoseSmoother {
 public:
  /// Requires: validate(options).
  explicit PoseSmoother(const PoseRefinementOptions& options);

  /// Notes the next frame of the sequence: its given pose, what PoseRefiner::refine made of it, and
  /// what PoseRefiner::add returned.
  void add(const MapFromCamera& given,
           const PoseCorrection& correction,
           const std::optional<RegisteredPose>& registered);

  /// Frames that were added and not taken.
  [[nodiscard]] std::size_t num_waiting() const noexcept { return frames_.size() - num_taken_; }

  /// The pose of the earliest frame that waits, by all that were added; the given one where it was
  /// not registered, or where the correction exceeds the options' limits (kTooLarge).
  /// Requires: num_waiting() > 0. Cost: O(frames that are kept).
  [[nodiscard]] SmoothedPose take();

 private:
  struct Frame {
    MapFromCamera given;
    PoseCorrection correction;
    std::optional<RegisteredPose> registered;
  };
  [[nodiscard]] SmoothedPose pose_at(std::size_t position) const;
  /// Brings the surfaces that the frame at the position was registered to into the map.
  [[nodiscard]] Eigen::Isometry3d map_from_model_at(std::size_t position) const;

  PoseRefinementOptions options_;
  std::deque<Frame> frames_;   ///< Those taken last, then those that wait.
  std::size_t num_taken_ = 0;  ///< Of `frames_`.
};

}  // namespace hypermap

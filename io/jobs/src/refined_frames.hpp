// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames of a run in order, each at the pose at which it is put into the map.
#pragma once

#include "frame_stream.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/registration/pose_refiner.hpp"
#include "hypermap/core/registration/pose_smoother.hpp"
#include "hypermap/core/segmentation/depth_smoothing.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <cstddef>
#include <deque>
#include <functional>

namespace hypermap {

/// A prepared frame, which says its given pose, and where it stands in the map.
struct PosedFrame {
  PreparedFrame prepared;
  MapFromCamera map_from_camera;
  PoseCorrection correction;  ///< How the two differ.
  double wait_s = 0.0;        ///< Until the frame was prepared.
  double refine_s = 0.0;
};

/// Refines the poses of a stream's frames, each by those before it and the `lag_frames` after it;
/// without a rule of refinement they are as given, and nothing waits.
/// Memory: that of the frames that wait.
class RefinedFrames {
 public:
  /// Which pixels of a frame are no surface.
  using LeftOutPixels = std::function<MaskImage(const RgbdFrame&)>;

  /// `num_frames`: that the stream has. Surfaces are those of smoothed depth; the frames keep their
  /// own. Requires: valid options, the stream outlives this.
  RefinedFrames(FrameStream& stream,
                std::size_t num_frames,
                const SemanticMapperOptions& options,
                LeftOutPixels left_out);

  /// The next frame or its error, in order; what reading or refining it throws is its error. A
  /// frame that validate() refuses keeps its pose. Requires: called at most `num_frames` times.
  [[nodiscard]] Result<PosedFrame> next();

 private:
  [[nodiscard]] bool is_refining() const { return options_.rule != PoseRefinementRule::kNone; }
  /// The stream's next frame, which the smoother has a pose of if it is refined.
  [[nodiscard]] Result<PosedFrame> take_in();
  void refine(const RgbdFrame& given);

  FrameStream& stream_;
  std::size_t num_left_;  ///< In the stream.
  PoseRefinementOptions options_;
  int num_threads_;
  LeftOutPixels left_out_;
  DepthSmoother depth_smoother_;
  PoseRefiner refiner_;
  PoseSmoother pose_smoother_;  ///< Of the frames that wait, but those that could not be read.
  std::deque<Result<PosedFrame>> waiting_;
};

}  // namespace hypermap

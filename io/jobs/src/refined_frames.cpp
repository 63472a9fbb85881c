// SPDX-License-Identifier: BSD-3-Clause
#include "refined_frames.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/core/base/stop_watch.hpp"

#include <cassert>
#include <utility>

namespace hypermap {

RefinedFrames::RefinedFrames(FrameStream& stream,
                             std::size_t num_frames,
                             const SemanticMapperOptions& options,
                             LeftOutPixels left_out)
    : stream_(stream),
      num_left_(num_frames),
      options_(options.refinement),
      num_threads_(options.num_threads),
      left_out_(std::move(left_out)),
      depth_smoother_(options.smoothing),
      refiner_(options.refinement),
      pose_smoother_(options.refinement) {}

Result<PosedFrame> RefinedFrames::next() {
  const std::size_t num_later =
      is_refining() ? static_cast<std::size_t>(options_.lag_frames) : std::size_t{0};
  while (num_left_ > 0 && waiting_.size() <= num_later) {
    --num_left_;
    waiting_.push_back(guarded(ErrorCode::kUnavailable, "the frame", [this] { return take_in(); }));
  }
  assert(!waiting_.empty());
  Result<PosedFrame> frame = std::move(waiting_.front());
  waiting_.pop_front();
  if (!frame || !is_refining()) return frame;
  const SmoothedPose pose = pose_smoother_.take();
  frame->map_from_camera = pose.map_from_camera;
  frame->correction = pose.correction;
  return frame;
}

Result<PosedFrame> RefinedFrames::take_in() {
  StopWatch watch;
  HYPERMAP_ASSIGN_OR_RETURN(PreparedFrame prepared, stream_.next());
  PosedFrame frame{.prepared = std::move(prepared), .map_from_camera = {}, .correction = {}};
  frame.map_from_camera = frame.prepared.frame.map_from_camera;
  frame.wait_s = watch.lap();
  if (!is_refining()) return frame;
  refine(frame.prepared.frame);
  frame.refine_s = watch.lap();
  return frame;
}

void RefinedFrames::refine(const RgbdFrame& given) {
  if (!validate(given)) {  // whoever maps it says why
    pose_smoother_.add(given.map_from_camera, {}, {});
    return;
  }
  const RgbdFrame frame{.index = given.index,
                        .name = given.name,
                        .stamp = given.stamp,
                        .camera = given.camera,
                        .map_from_camera = given.map_from_camera,
                        .depth_m = depth_smoother_.smoothed(given.depth_m, num_threads_),
                        .color = {},
                        .detections = {}};
  const RefinedPose refined = refiner_.refine(frame, left_out_(given));
  const auto registered = refiner_.add(frame, refined);
  pose_smoother_.add(given.map_from_camera, refined.correction, registered);
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include "segmentation/policies/segmentation_policies.hpp"

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <new>
#include <numeric>
#include <optional>

namespace hypermap {
namespace {

Result<Segment> dispatch(const RgbdFrame& frame,
                         const Detection& detection,
                         std::span<const Detection> others,
                         const GeometricSegmentationOptions& options,
                         StepRecorder* recorder) {
  switch (options.policy) {
    case SegmentationPolicy::kCluster:
      return segment_by_cluster(frame, detection, options, recorder);
    case SegmentationPolicy::kRegionGrowing:
      return segment_by_region_growing(frame, detection, options, recorder);
    case SegmentationPolicy::kForeground:
      break;
  }
  return segment_by_foreground(frame, detection, others, options, recorder);
}

/// PCL throws; no exception leaves a public function.
Result<Segment> dispatch_without_throwing(const RgbdFrame& frame,
                                          const Detection& detection,
                                          std::span<const Detection> others,
                                          const GeometricSegmentationOptions& options,
                                          StepRecorder* recorder) {
  try {
    return dispatch(frame, detection, others, options, recorder);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "not enough memory", "segmentation");
  } catch (const std::exception& thrown) {
    return fail(ErrorCode::kUnavailable, printable(thrown.what()), "segmentation");
  }
}

/// Hands out the detections of a frame, the surest first, while there may be more.
class WorkList {
 public:
  WorkList(std::span<const Detection> detections, const MayBegin& may_begin)
      : may_begin_(may_begin), order_(detections.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return detections[a].score > detections[b].score;
    });
  }

  [[nodiscard]] std::optional<std::size_t> next() {
    const std::lock_guard lock(mutex_);
    if (next_ == order_.size()) return std::nullopt;
    if (may_begin_ && !may_begin_()) {
      next_ = order_.size();
      return std::nullopt;
    }
    return order_[next_++];
  }

 private:
  const MayBegin& may_begin_;
  std::vector<std::size_t> order_;
  std::mutex mutex_;
  std::size_t next_ = 0;
};

}  // namespace

Result<Segment> segment(const RgbdFrame& frame,
                        const Detection& detection,
                        const GeometricSegmentationOptions& options) {
  return dispatch_without_throwing(frame, detection, frame.detections, options, nullptr);
}

std::vector<Result<Segment>> segment_all(const RgbdFrame& frame,
                                         std::span<const Detection> detections,
                                         const GeometricSegmentationOptions& options,
                                         int threads,
                                         const MayBegin& may_begin) {
  // One by one: where memory ends, copying a result that holds an error would end the program.
  std::vector<Result<Segment>> segments;
  segments.reserve(detections.size());
  for (std::size_t i = 0; i < detections.size(); ++i)
    segments.emplace_back(fail(ErrorCode::kInterrupted, "no time was left for it", "segmentation"));
  WorkList list(detections, may_begin);
  const auto work = [&] {
    while (const auto i = list.next()) {
      segments[*i] = dispatch_without_throwing(frame, detections[*i], detections, options, nullptr);
    }
  };
  // More threads than the machine has would only make TBB complain.
  const int num_workers = std::min(threads, tbb::info::default_concurrency());
  if (num_workers == 1 || detections.size() < 2) {
    work();
    return segments;
  }
  tbb::task_arena arena(num_workers);
  arena.execute([&] { tbb::parallel_for(0, num_workers, [&](int) { work(); }); });
  return segments;
}

SegmentationTrace trace_segmentation(const RgbdFrame& frame,
                                     const Detection& detection,
                                     const GeometricSegmentationOptions& options) {
  StepRecorder recorder(frame.camera.width_px, frame.camera.height_px);
  Result<Segment> found =
      dispatch_without_throwing(frame, detection, frame.detections, options, &recorder);
  return {.steps = std::move(recorder).take(), .segment = std::move(found)};
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometric_segmentation.hpp"

#include "segmentation/segmentation_policies.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <exception>
#include <new>

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

}  // namespace

Result<Segment> segment(const RgbdFrame& frame,
                        const Detection& detection,
                        const GeometricSegmentationOptions& options) {
  return dispatch_without_throwing(frame, detection, frame.detections, options, nullptr);
}

std::vector<Result<Segment>> segment_all(const RgbdFrame& frame,
                                         std::span<const Detection> detections,
                                         const GeometricSegmentationOptions& options,
                                         int threads) {
  std::vector<Result<Segment>> segments(detections.size());
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, detections.size(), [&](std::size_t i) {
      segments[i] = dispatch_without_throwing(frame, detections[i], detections, options, nullptr);
    });
  });
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

// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/frame_observations.hpp"

#include <new>
#include <utility>

namespace hypermap {

FrameObservations observe(const RgbdFrame& frame,
                          std::span<const Detection> detections,
                          const SemanticMapperOptions& options,
                          const MayBegin& may_begin) {
  auto segments =
      segment_all(frame, detections, options.objects.segmentation, options.num_threads, may_begin);
  FrameObservations seen;
  seen.observations.reserve(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (segments[i]) {
      seen.observations.push_back(make_observation(frame, detections[i], std::move(*segments[i])));
      continue;
    }
    if (segments[i].error().code == ErrorCode::kOutOfMemory) throw std::bad_alloc();
    const bool was_begun = segments[i].error().code != ErrorCode::kInterrupted;
    (was_begun ? seen.without_segment : seen.not_begun).push_back(&detections[i]);
  }
  return seen;
}

}  // namespace hypermap

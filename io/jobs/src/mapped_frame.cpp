// SPDX-License-Identifier: BSD-3-Clause
#include "mapped_frame.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

/// Whether what a frame does not show of the objects was missed: by the network, or by a detector
/// whose detections were read.
DetectorLook look_at(const PreparedFrame& prepared, const MappingRun& run, const MappingJob& job) {
  const bool has_others = !job.dataset.detections.empty() || !prepared.frame.detections.empty();
  const bool is_looked = prepared.is_looked_at || has_others || !run.detector;
  return is_looked ? DetectorLook::kLooked : DetectorLook::kNotLooked;
}

/// Puts the frame where it stands in the map; it keeps its given pose.
Result<FrameReport> integrate(MappingRun& run, PosedFrame& posed, const MappingJob& job) {
  RgbdFrame& frame = posed.prepared.frame;
  const MapFromCamera given = std::exchange(frame.map_from_camera, posed.map_from_camera);
  auto done = run.mapper->integrate(frame, look_at(posed.prepared, run, job));
  frame.map_from_camera = given;
  if (!done) return done;
  done->pose = posed.correction;
  done->seconds.refine = posed.refine_s;
  return done;
}

}  // namespace

Result<FrameReport> map_frame(MappingRun& run,
                              std::size_t index,
                              Result<PosedFrame> posed,
                              const MappingJob& job,
                              MappingReport& report) {
  if (!posed) return Unexpected(std::move(posed).error());
  const PreparedFrame& prepared = posed->prepared;
  report.seconds.read += prepared.read_s;
  report.seconds.detect += prepared.detect_s;
  report.frame_times.add(FrameStage::kRead, prepared.read_s);
  report.frame_times.add(FrameStage::kDetect, prepared.detect_s);
  RgbdFrame& frame = posed->prepared.frame;
  frame.index += run.index_offset;
  HYPERMAP_ASSIGN_OR_RETURN(FrameReport done, integrate(run, *posed, job));
  report.num_looks += prepared.is_looked_at ? 1U : 0U;
  run.last = {.position = index, .hash = run.fingerprint.add(frame)};
  run.next_frame_index = frame.index + 1;
  run.first_stamp = std::min(run.first_stamp.value_or(frame.stamp), frame.stamp);
  run.last_stamp = std::max(run.last_stamp.value_or(frame.stamp), frame.stamp);
  if (run.first.hash.empty()) run.first = run.last;
  run.places.push_back({index, frame.map_from_camera.origin().xyz});
  run.views.follow(done, run.mapper->objects());
  if (job.keep_views) HYPERMAP_TRY(run.views.add(frame, done));
  return done;
}

}  // namespace hypermap

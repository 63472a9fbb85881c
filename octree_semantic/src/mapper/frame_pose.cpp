// SPDX-License-Identifier: BSD-3-Clause
// A frame's depth, and the pose at which it stands in the map.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "integration/frame_checks.hpp"
#include "mapper/borrowed_frames.hpp"
#include "mapper/transient_observations.hpp"

#include <new>
#include <utility>
#include <vector>

namespace hypermap {

DepthImage SemanticMapper::smoothed_depth(const RgbdFrame& given) {
  if (options_.smoothing.rule == DepthSmoothingRule::kNone) return borrowed(given.depth_m);
  return smoother_.smoothed(given.depth_m, options_.num_threads);
}

MaskImage SemanticMapper::transient_pixels(const PinholeCamera& camera,
                                           std::span<const Detection> detections) const {
  std::vector<const Detection*> transient;
  for (const Detection& detection : detections) {
    if (class_filter_.is_transient(detection.class_scores)) transient.push_back(&detection);
  }
  return pixels_shown_by(camera, transient);
}

Result<FrameReport> SemanticMapper::integrate_refined(const RgbdFrame& frame,
                                                      std::span<const Detection> given_detections,
                                                      DetectorLook look,
                                                      StopWatch& watch) {
  const RefinedPose refined =
      refiner_.refine(frame, transient_pixels(frame.camera, given_detections));
  HYPERMAP_TRY(check_sensor(octree_.grid(), refined.map_from_camera.origin(), "map_from_camera"));
  const double refine_s = watch.lap();
  HYPERMAP_ASSIGN_OR_RETURN(
      FrameReport report,
      integrate_at_pose(at_pose(frame, refined.map_from_camera), given_detections, look, watch));
  report.pose = refined.correction;
  try {
    refiner_.add(frame, refined);
  } catch (const std::bad_alloc&) {
    report.pose.is_added = false;  // the frame is in the map
  }
  report.seconds.refine = refine_s + watch.lap();
  return report;
}

}  // namespace hypermap

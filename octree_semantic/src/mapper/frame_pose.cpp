// SPDX-License-Identifier: BSD-3-Clause
// The pose at which a frame stands in the map.
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "integration/frame_checks.hpp"

#include <algorithm>
#include <new>
#include <type_traits>
#include <utility>

namespace hypermap {
namespace {

/// The frame at another pose, with borrowed images and without its detections.
RgbdFrame at_pose(const RgbdFrame& frame, const MapFromCamera& map_from_camera) {
  const auto borrow = [](const auto& image) {
    return std::remove_cvref_t<decltype(image)>::borrowed(
        image.width_px(), image.height_px(), image.pixels().data());
  };
  return {.index = frame.index,
          .name = frame.name,
          .stamp = frame.stamp,
          .camera = frame.camera,
          .map_from_camera = map_from_camera,
          .depth_m = borrow(frame.depth_m),
          .color = borrow(frame.color),
          .detections = {}};
}

/// Marks the pixels of the detection: of its mask, else of its box.
void mark(const Detection& detection, MaskImage& marks) {
  const PixelRect rect = pixels_in(detection.box_px, marks.width_px(), marks.height_px());
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      if (!detection.mask || detection.mask->at(u, v) != 0) marks.at(u, v) = 1;
    }
  }
}

}  // namespace

bool SemanticMapper::ClassFilter::is_transient(std::span<const ClassEvidence> class_scores) const {
  const auto best = best_class(class_scores);
  return best && std::ranges::binary_search(transient, best->id);
}

/// What moves is no surface to go by.
RefinedPose SemanticMapper::refine(const RgbdFrame& given) const {
  MaskImage transient;
  for (const Detection& detection : given.detections) {
    if (!class_filter_.is_transient(detection.class_scores)) continue;
    if (transient.empty()) transient = MaskImage(given.camera.width_px, given.camera.height_px);
    mark(detection, transient);
  }
  return refiner_.refine(given, transient);
}

Result<FrameReport> SemanticMapper::integrate_refined(const RgbdFrame& given,
                                                      DetectorLook look,
                                                      StopWatch& watch) {
  const RefinedPose refined = refine(given);
  HYPERMAP_TRY(check_sensor(octree_.grid(), refined.map_from_camera.origin(), "map_from_camera"));
  const double refine_s = watch.lap();
  const RgbdFrame frame = at_pose(given, refined.map_from_camera);
  HYPERMAP_ASSIGN_OR_RETURN(FrameReport report,
                            integrate_at_pose(frame, given.detections, look, watch));
  report.pose = refined.correction;
  try {
    refiner_.add(given, refined);
  } catch (const std::bad_alloc&) {
    report.pose.is_added = false;  // the frame is in the map
  }
  report.seconds.refine = refine_s + watch.lap();
  return report;
}

Result<PoseCorrection> SemanticMapper::add_surfaces(const RgbdFrame& frame) {
  if (options_.refinement.rule == PoseRefinementRule::kNone) return PoseCorrection{};
  HYPERMAP_TRY(check(frame));
  try {
    const RefinedPose refined = refine(frame);
    refiner_.add(frame, refined);
    return refined.correction;
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kOutOfMemory, "out of memory");
  }
}

}  // namespace hypermap

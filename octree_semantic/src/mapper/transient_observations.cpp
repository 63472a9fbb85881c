// SPDX-License-Identifier: BSD-3-Clause
#include "mapper/transient_observations.hpp"

#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/masks.hpp"
#include "mapper/borrowed_frames.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

namespace hypermap {
namespace {

MaskImage united(MaskImage a, const MaskImage& b) {
  std::ranges::transform(a.pixels(), b.pixels(), a.pixels().begin(), std::bit_or());
  return a;
}

MaskImage pixels_of_box(const PinholeCamera& camera, const PixelBox& box_px) {
  MaskImage pixels(camera.width_px, camera.height_px);
  const PixelRect rect = pixels_in(box_px, camera.width_px, camera.height_px);
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) pixels.at(u, v) = 1;
  }
  return pixels;
}

MaskImage pixels_of(const RgbdFrame& frame, std::span<const Observation> observations) {
  MaskImage segments(frame.camera.width_px, frame.camera.height_px);
  for (const Observation& observation : observations) {
    for (const std::uint32_t pixel : observation.segment.pixel_indices)
      segments.pixels()[pixel] = 1;
  }
  return segments;
}

/// Of an image that may be empty.
bool is_set(const MaskImage& image, std::size_t pixel) {
  return !image.pixels().empty() && image.pixels()[pixel] != 0;
}

}  // namespace

MaskImage pixels_shown_by(const PinholeCamera& camera,
                          std::span<const Detection* const> detections) {
  if (detections.empty()) return {};
  MaskImage shown(camera.width_px, camera.height_px);
  for (const Detection* detection : detections) {
    shown = united(std::move(shown),
                   detection->mask ? widened_by_tolerance(*detection->mask)
                                   : pixels_of_box(camera, detection->box_px));
  }
  return shown;
}

StillFrame without_transient(const RgbdFrame& frame,
                             const TransientDetections& transient,
                             const SegmentedDepth& segmented) {
  const MaskImage near_segments = widened_by_tolerance(pixels_of(frame, transient.observations));
  const MaskImage not_begun = pixels_shown_by(frame.camera, transient.not_begun);
  const MaskImage without_segment = pixels_shown_by(frame.camera, transient.without_segment);
  DepthImage depth_m(frame.camera.width_px, frame.camera.height_px);
  std::size_t num_left_out = 0;
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    const float z_m = frame.depth_m.pixels()[i];
    const bool is_segmented = segmented.contains(static_cast<double>(z_m));
    const bool is_left_out =
        is_measured(z_m) && (is_set(near_segments, i) || is_set(not_begun, i) ||
                             (is_set(without_segment, i) && !is_segmented));
    depth_m.pixels()[i] = is_left_out ? 0.0F : z_m;
    if (is_left_out) ++num_left_out;
  }
  return {.frame = with_depth(frame, std::move(depth_m)), .num_left_out = num_left_out};
}

}  // namespace hypermap

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
                             std::span<const Observation> observations,
                             std::span<const Detection* const> without_segment) {
  MaskImage segments(frame.camera.width_px, frame.camera.height_px);
  for (const Observation& observation : observations) {
    for (const std::uint32_t pixel : observation.segment.pixel_indices)
      segments.pixels()[pixel] = 1;
  }
  MaskImage left_out = widened_by_tolerance(segments);
  if (!without_segment.empty())
    left_out = united(std::move(left_out), pixels_shown_by(frame.camera, without_segment));
  DepthImage depth_m(frame.camera.width_px, frame.camera.height_px);
  std::size_t num_left_out = 0;
  std::ranges::transform(frame.depth_m.pixels(),
                         left_out.pixels(),
                         depth_m.pixels().begin(),
                         [&num_left_out](float z_m, std::uint8_t is_out) {
                           if (is_out == 0 || z_m <= 0.0F) return z_m;
                           ++num_left_out;
                           return 0.0F;
                         });
  return {.frame = with_depth(frame, std::move(depth_m)), .num_left_out = num_left_out};
}

}  // namespace hypermap

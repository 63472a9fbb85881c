// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <algorithm>

namespace hypermap {
namespace {

/// First whole number n in [0, side] whose pixel centre n + 0.5 is not left of `edge_px`.
/// Clamped before the conversion, since casting a huge double to int is undefined.
int first_pixel_from(double edge_px, int side_px) {
  return static_cast<int>(std::clamp(std::ceil(edge_px - 0.5), 0.0, static_cast<double>(side_px)));
}

}  // namespace

PixelRect pixels_in(
    const PixelBox& box, int width_px, int height_px, double margin_u_px, double margin_v_px) {
  if (!(box.u_min_px < box.u_max_px) || !(box.v_min_px < box.v_max_px)) return {};
  const PixelRect rect{.u_begin = first_pixel_from(box.u_min_px - margin_u_px, width_px),
                       .v_begin = first_pixel_from(box.v_min_px - margin_v_px, height_px),
                       .u_end = first_pixel_from(box.u_max_px + margin_u_px, width_px),
                       .v_end = first_pixel_from(box.v_max_px + margin_v_px, height_px)};
  return rect.empty() ? PixelRect{} : rect;
}

}  // namespace hypermap

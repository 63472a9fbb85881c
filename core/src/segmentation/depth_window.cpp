// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/depth_window.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// A detector's edges are off by a few percent; what sticks out so little is still inside.
constexpr double kBoxToleranceShare = 0.06;
constexpr double kBoxTolerancePx = 1.5;

/// Depth of the window's cells, 0 where there is no measurement within range.
std::vector<float> cut_out(const DepthImage& depth_m,
                           const PixelRect& rect,
                           const GeometricSegmentationOptions& options) {
  const auto nearest = static_cast<float>(options.min_range_m);
  const auto farthest = static_cast<float>(options.max_range_m);
  std::vector<float> out;
  out.reserve(static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height()));
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      const float depth = depth_m.at(u, v);
      out.push_back(depth > 0.0F && depth >= nearest && depth <= farthest ? depth : 0.0F);
    }
  }
  return out;
}

/// Mean over the 3 x 3 neighbours whose depth is within the step of one surface. Independent noise
/// falls to a third, which is what lifts a keyboard out of its table.
std::vector<float> smoothed(const DepthWindow& window, const ForegroundOptions& options) {
  std::vector<float> out(window.size(), 0.0F);
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      const float centre = window.depth_m[window.cell(x, y)];
      if (centre == 0.0F) continue;
      const float step = allowed_step_m(centre, options);
      float sum = 0.0F;
      float count = 0.0F;
      for (int ny = std::max(0, y - 1); ny <= std::min(window.height() - 1, y + 1); ++ny) {
        for (int nx = std::max(0, x - 1); nx <= std::min(window.width() - 1, x + 1); ++nx) {
          const float depth = window.depth_m[window.cell(nx, ny)];
          const bool same_surface = depth > 0.0F && std::abs(depth - centre) <= step;
          sum += same_surface ? depth : 0.0F;
          count += same_surface ? 1.0F : 0.0F;
        }
      }
      out[window.cell(x, y)] = sum / count;
    }
  }
  return out;
}

std::vector<float> slopes(int begin, int end, double centre_px, double focal_px) {
  std::vector<float> out;
  for (int pixel = begin; pixel < end; ++pixel) {
    out.push_back(static_cast<float>((pixel - centre_px) / focal_px));
  }
  return out;
}

PixelBox bounds_of(const MaskImage& mask) {
  PixelBox box{static_cast<double>(mask.width_px()), static_cast<double>(mask.height_px()), 0, 0};
  for (int v = 0; v < mask.height_px(); ++v) {
    for (int u = 0; u < mask.width_px(); ++u) {
      if (mask.at(u, v) == 0) continue;
      box = {.u_min_px = std::min(box.u_min_px, static_cast<double>(u)),
             .v_min_px = std::min(box.v_min_px, static_cast<double>(v)),
             .u_max_px = std::max(box.u_max_px, u + 1.0),
             .v_max_px = std::max(box.v_max_px, v + 1.0)};
    }
  }
  return box;
}

}  // namespace

DepthWindow make_depth_window(const RgbdFrame& frame,
                              const Detection& detection,
                              const GeometricSegmentationOptions& options) {
  const PixelBox box_px = detection.mask ? bounds_of(*detection.mask) : detection.box_px;
  const ForegroundOptions& foreground = options.foreground;
  const auto grown_by = [&](double share, double least_px) {
    return pixels_in(box_px,
                     frame.camera.width_px,
                     frame.camera.height_px,
                     std::max(share * box_px.width_px(), least_px),
                     std::max(share * box_px.height_px(), least_px));
  };
  DepthWindow window;
  window.box = grown_by(0.0, 0.0);
  if (window.box.empty()) return window;
  window.tolerant_box = grown_by(kBoxToleranceShare, kBoxTolerancePx);
  window.rect = foreground.context_share > 0.0
                    ? grown_by(foreground.context_share, foreground.context_min_px)
                    : window.box;
  const PinholeCamera& camera = frame.camera;
  window.slope_x = slopes(window.rect.u_begin, window.rect.u_end, camera.cx_px, camera.fx_px);
  window.slope_y = slopes(window.rect.v_begin, window.rect.v_end, camera.cy_px, camera.fy_px);
  window.depth_m = cut_out(frame.depth_m, window.rect, options);
  window.depth_m = smoothed(window, foreground);
  return window;
}

}  // namespace hypermap

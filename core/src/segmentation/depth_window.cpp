// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/depth_window.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// A detector's edges are off by a few percent; what sticks out so little is still inside.
constexpr double kBoxToleranceShare = 0.06;
constexpr double kBoxTolerancePx = 1.5;
constexpr double kSameThingOverlap = 0.7;

/// Larger windows are looked at in blocks, so that a couch costs no more than a chair.
constexpr int kMaxCells = 32768;
constexpr int kMaxBlockPx = 4;

int block_for(const PixelRect& rect) {
  int block_px = 1;
  const double area = static_cast<double>(rect.width()) * rect.height();
  while (block_px < kMaxBlockPx && area > static_cast<double>(kMaxCells) * block_px * block_px) {
    ++block_px;
  }
  return block_px;
}

/// Reads depth; 0 where there is no measurement within range, or where a mask says no.
class DepthReader {
 public:
  DepthReader(const RgbdFrame& frame,
              const Detection& detection,
              const GeometricSegmentationOptions& options)
      : depth_m_(frame.depth_m),
        mask_(detection.mask ? &*detection.mask : nullptr),
        nearest_(static_cast<float>(options.min_range_m)),
        farthest_(static_cast<float>(options.max_range_m)) {}

  [[nodiscard]] float at(int u, int v) const {
    const float depth = depth_m_.at(u, v);
    if (!(depth > 0.0F && depth >= nearest_ && depth <= farthest_)) return 0.0F;
    return mask_ == nullptr || mask_->at(u, v) != 0 ? depth : 0.0F;
  }

  /// Mean over the 3 x 3 pixels within `rect` that are on the surface of (u, v).
  [[nodiscard]] float smoothed_at(int u,
                                  int v,
                                  const PixelRect& rect,
                                  const ForegroundOptions& options) const {
    const float centre = at(u, v);
    if (centre == 0.0F) return 0.0F;
    const float step = allowed_step_m(centre, options);
    float sum = 0.0F;
    float count = 0.0F;
    for (int nv = std::max(rect.v_begin, v - 1); nv <= std::min(rect.v_end - 1, v + 1); ++nv) {
      for (int nu = std::max(rect.u_begin, u - 1); nu <= std::min(rect.u_end - 1, u + 1); ++nu) {
        const float depth = at(nu, nv);
        const bool same_surface = depth > 0.0F && std::abs(depth - centre) <= step;
        sum += same_surface ? depth : 0.0F;
        count += same_surface ? 1.0F : 0.0F;
      }
    }
    return sum / count;
  }

 private:
  const DepthImage& depth_m_;
  const MaskImage* mask_;
  float nearest_;
  float farthest_;
};

/// The cells whose middle pixel lies in `pixels`.
PixelRect cells_in(const PixelRect& pixels, const DepthWindow& window) {
  PixelRect cells{0, 0, 0, 0};
  const auto count_before = [](int end, int limit, auto pixel_of) {
    int n = 0;
    while (n < end && pixel_of(n) < limit) ++n;
    return n;
  };
  const auto u_of = [&](int x) { return window.pixel_u(x); };
  const auto v_of = [&](int y) { return window.pixel_v(y); };
  cells.u_begin = count_before(window.width(), pixels.u_begin, u_of);
  cells.u_end = count_before(window.width(), pixels.u_end, u_of);
  cells.v_begin = count_before(window.height(), pixels.v_begin, v_of);
  cells.v_end = count_before(window.height(), pixels.v_end, v_of);
  return cells;
}

double overlap(const PixelBox& a, const PixelBox& b) {
  const double width = std::min(a.u_max_px, b.u_max_px) - std::max(a.u_min_px, b.u_min_px);
  const double height = std::min(a.v_max_px, b.v_max_px) - std::max(a.v_min_px, b.v_min_px);
  const double common = std::max(0.0, width) * std::max(0.0, height);
  return common / (a.width_px() * a.height_px() + b.width_px() * b.height_px() - common);
}

/// Boxes of other things. A box almost the same as ours may be another name for our thing.
std::vector<PixelRect> rivals_of(const PixelBox& box_px,
                                 std::span<const Detection> others,
                                 const PinholeCamera& camera,
                                 const DepthWindow& window) {
  std::vector<PixelRect> rivals;
  for (const Detection& other : others) {
    if (!(overlap(other.box_px, box_px) < kSameThingOverlap)) continue;
    const PixelRect pixels = pixels_in(other.box_px, camera.width_px, camera.height_px);
    const PixelRect cells = cells_in(pixels, window);
    if (!cells.empty()) rivals.push_back(cells);
  }
  return rivals;
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
                              std::span<const Detection> others,
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
  const PixelRect box = grown_by(0.0, 0.0);
  DepthWindow window;
  if (box.empty()) return window;
  window.rect = foreground.context_share > 0.0
                    ? grown_by(foreground.context_share, foreground.context_min_px)
                    : box;
  window.block_px = block_for(window.rect);
  const int width = (window.rect.width() + window.block_px - 1) / window.block_px;
  const int height = (window.rect.height() + window.block_px - 1) / window.block_px;
  const PinholeCamera& camera = frame.camera;
  for (int x = 0; x < width; ++x) {
    window.slope_x.push_back(static_cast<float>((window.pixel_u(x) - camera.cx_px) / camera.fx_px));
  }
  for (int y = 0; y < height; ++y) {
    window.slope_y.push_back(static_cast<float>((window.pixel_v(y) - camera.cy_px) / camera.fy_px));
  }
  window.box = cells_in(box, window);
  window.tolerant_box = cells_in(grown_by(kBoxToleranceShare, kBoxTolerancePx), window);
  window.rivals = rivals_of(box_px, others, frame.camera, window);
  const DepthReader reader(frame, detection, options);
  window.depth_m.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      window.depth_m.push_back(
          reader.smoothed_at(window.pixel_u(x), window.pixel_v(y), window.rect, foreground));
    }
  }
  return window;
}

}  // namespace hypermap

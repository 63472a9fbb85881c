// SPDX-License-Identifier: BSD-3-Clause
#include "depth_window.hpp"

#include "hypermap/core/segmentation/masks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

/// A detector's edges are off by a few percent; what sticks out so little is still inside.
constexpr double kBoxToleranceShare = 0.06;
constexpr double kBoxTolerancePx = 1.5;
constexpr double kSameObjectOverlap = 0.7;

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

/// No measurement within range: on the surface of no measured depth.
constexpr float kNothing = -1e6F;

/// Rows of a cut-out, with `kNothing` where there is nothing.
class CleanRows {
 public:
  CleanRows(const RgbdFrame& frame,
            const PixelRect& rect,
            const GeometricSegmentationOptions& options)
      : depth_m_(frame.depth_m),
        rect_(rect),
        nearest_(std::max(static_cast<float>(options.min_range_m),
                          std::numeric_limits<float>::denorm_min())),
        farthest_(static_cast<float>(options.max_range_m.value_or(kDefaultMaxRangeM))),
        nothing_(static_cast<std::size_t>(rect.width()) + 2, kNothing) {
    rows_.fill(nothing_);
    held_.fill(-1);
  }

  /// Row `v` of the image with nothing before and behind it; nothing outside the cut-out. Valid
  /// until a row three or more away is asked for.
  [[nodiscard]] const std::vector<float>& row(int v) {
    if (v < rect_.v_begin || v >= rect_.v_end) return nothing_;
    const auto slot = static_cast<std::size_t>(v) % rows_.size();
    if (held_[slot] != v) read(v, rows_[slot]);
    held_[slot] = v;
    return rows_[slot];
  }

 private:
  void read(int v, std::vector<float>& into) const {
    const std::size_t first = depth_m_.index(rect_.u_begin, v);
    const auto depths = depth_m_.pixels().subspan(first, nothing_.size() - 2);
    for (std::size_t i = 0; i < depths.size(); ++i) {
      const float far_enough = depths[i] >= nearest_ ? depths[i] : kNothing;
      into[i + 1] = far_enough <= farthest_ ? far_enough : kNothing;
    }
  }

  const DepthImage& depth_m_;
  PixelRect rect_;
  float nearest_;
  float farthest_;
  std::vector<float> nothing_;
  std::array<std::vector<float>, 3> rows_;
  std::array<int, 3> held_ = {};
};

/// `allowed_step_m` of each depth.
void find_steps(std::span<const float> depths_m,
                const ForegroundOptions& options,
                std::span<float> into) {
  for (std::size_t i = 0; i < depths_m.size(); ++i) into[i] = allowed_step_m(depths_m[i], options);
}

/// The 3 x 3 pixels around each of some cells: neighbour k of cell i is [k][i], the fifth the
/// cell's.
using Neighbours = std::array<std::span<const float>, 9>;
constexpr std::size_t kCentre = 4;

/// A sum over those neighbours that lie on the surface of the cell. Without branches, so that a
/// compiler does several cells at a time.
struct SurfaceSum {
  float centre = 0.0F;
  float step = 0.0F;
  float sum = 0.0F;
  float count = 0.0F;

  void add(float depth_m) {
    const float weight = std::abs(depth_m - centre) <= step ? 1.0F : 0.0F;
    sum += weight * depth_m;
    count += weight;
  }
  /// 0 where the cell is no measurement. One that is counts itself.
  [[nodiscard]] float mean() const { return centre > 0.0F ? sum / count : 0.0F; }
};

void find_means(const Neighbours& neighbours, std::span<const float> steps, std::span<float> into) {
  for (std::size_t i = 0; i < into.size(); ++i) {
    SurfaceSum sum{.centre = neighbours[kCentre][i], .step = steps[i]};
    for (const std::span<const float> neighbour : neighbours) sum.add(neighbour[i]);
    into[i] = sum.mean();
  }
}

/// Smooths a row of cells: the mean of what lies on the surface of each among its neighbours.
class RowSmoother {
 public:
  RowSmoother(const DepthWindow& window, const ForegroundOptions& options)
      : options_(options), is_by_pixel_(window.block_px == 1), step_(window.slope_x.size()) {
    for (std::vector<float>& picked : picked_) picked.resize(is_by_pixel_ ? 0 : step_.size());
    for (int x = 0; x < window.width(); ++x) columns_.push_back(window.pixel_u(x));
    for (int& column : columns_) column -= window.rect.u_begin;
  }

  /// The means of the row at `v`; 0 where the cell's own pixel is no measurement.
  void smooth(CleanRows& rows, int v, std::span<float> into) {
    Neighbours neighbours;
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      const std::vector<float>& row = rows.row(v + static_cast<int>(k / 3) - 1);
      neighbours[k] = is_by_pixel_ ? std::span(row).subspan(k % 3, step_.size()) : pick(row, k);
    }
    find_steps(neighbours[kCentre], options_, step_);
    find_means(neighbours, step_, into);
  }

 private:
  /// Neighbour `k` of the columns of blocks.
  [[nodiscard]] std::span<const float> pick(const std::vector<float>& row, std::size_t k) {
    std::vector<float>& picked = picked_[k];
    for (std::size_t i = 0; i < picked.size(); ++i) {
      picked[i] = row[static_cast<std::size_t>(columns_[i]) + k % 3];
    }
    return picked;
  }

  const ForegroundOptions& options_;
  bool is_by_pixel_;
  std::vector<int> columns_;  // within the cut-out
  std::vector<float> step_;
  std::array<std::vector<float>, 9> picked_;
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

/// Boxes of other objects. A box almost the same as ours may be another name for our object.
std::vector<CompetingBox> competing_boxes_of(const PixelBox& box_px,
                                             std::span<const Detection> others,
                                             const PinholeCamera& camera,
                                             const DepthWindow& window) {
  std::vector<CompetingBox> competing_boxes;
  for (const Detection& other : others) {
    if (!(intersection_over_union(other.box_px, box_px) < kSameObjectOverlap)) continue;
    const PixelRect pixels = pixels_in(other.box_px, camera.width_px, camera.height_px);
    const PixelRect cells = cells_in(pixels, window);
    if (!cells.empty()) competing_boxes.push_back({other.box_px, cells});
  }
  return competing_boxes;
}

/// 1 on the cells whose middle pixel is in the mask.
MaskImage cells_of_mask(const MaskImage& mask, const DepthWindow& window) {
  MaskImage cells(window.width(), window.height());
  for (int y = 0; y < window.height(); ++y) {
    for (int x = 0; x < window.width(); ++x) {
      cells.at(x, y) = mask.at(window.pixel_u(x), window.pixel_v(y)) != 0 ? 1 : 0;
    }
  }
  return cells;
}

PixelBox box_around(const MaskImage& mask) {
  const PixelRect bounds = bounds_of(mask);
  return {static_cast<double>(bounds.u_begin),
          static_cast<double>(bounds.v_begin),
          static_cast<double>(bounds.u_end),
          static_cast<double>(bounds.v_end)};
}

}  // namespace

DepthWindow make_depth_window(const RgbdFrame& frame,
                              const Detection& detection,
                              std::span<const Detection> others,
                              const GeometricSegmentationOptions& options) {
  const PixelBox box_px = detection.mask ? box_around(*detection.mask) : detection.box_px;
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
  window.box_px = box_px;
  window.box = cells_in(box, window);
  window.tolerant_box = cells_in(grown_by(kBoxToleranceShare, kBoxTolerancePx), window);
  window.competing_boxes = competing_boxes_of(box_px, others, frame.camera, window);
  CleanRows rows(frame, window.rect, options);
  RowSmoother smoother(window, foreground);
  window.depth_m.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    smoother.smooth(
        rows,
        window.pixel_v(y),
        std::span(window.depth_m).subspan(window.cell(0, y), static_cast<std::size_t>(width)));
  }
  window.step_m.resize(window.size());
  find_steps(window.depth_m, foreground, window.step_m);
  if (detection.mask) {
    window.in_mask = cells_of_mask(*detection.mask, window);
    const double tolerance_px = mask_tolerance_px(frame.camera.width_px, frame.camera.height_px);
    window.mask_tolerance = static_cast<int>(std::ceil(tolerance_px / window.block_px));
  }
  return window;
}

}  // namespace hypermap

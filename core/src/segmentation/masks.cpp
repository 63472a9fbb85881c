// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/masks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hypermap {
namespace {

/// Without an early end, so that a compiler looks at many pixels at once: most rows are empty.
bool is_empty(std::span<const std::uint8_t> row) {
  std::uint8_t any = 0;
  for (const std::uint8_t pixel : row) any = static_cast<std::uint8_t>(any | pixel);
  return any == 0;
}

/// Writes 1 within `reach` of a mark along one line of pixels, `stride` apart.
void widen_line(const std::uint8_t* marks,
                std::size_t count,
                std::size_t stride,
                std::size_t reach,
                std::uint8_t* into) {
  std::size_t end = 0;  // all before it are written
  for (std::size_t i = 0; i < count; ++i) {
    if (marks[i * stride] == 0) continue;
    const std::size_t last = std::min(count, i + reach + 1);
    for (std::size_t k = std::max(end, i - std::min(i, reach)); k < last; ++k) into[k * stride] = 1;
    end = std::max(end, last);
  }
}

}  // namespace

PixelRect bounds_of(const MaskImage& mask) {
  const auto width = static_cast<std::size_t>(mask.width_px());
  const auto is_set = [](std::uint8_t pixel) { return pixel != 0; };
  PixelRect bounds;
  for (int v = 0; v < mask.height_px(); ++v) {
    const auto row = mask.pixels().subspan(mask.index(0, v), width);
    if (is_empty(row)) continue;
    const auto begin = std::find_if(row.begin(), row.end(), is_set) - row.begin();
    const auto end = row.rend() - std::find_if(row.rbegin(), row.rend(), is_set);
    bounds = united(bounds, {static_cast<int>(begin), v, static_cast<int>(end), v + 1});
  }
  return bounds;
}

PixelBox box_with_mask(const Detection& detection) {
  const PixelBox& box = detection.box_px;
  const PixelRect mask = detection.mask ? bounds_of(*detection.mask) : PixelRect{};
  if (mask.empty()) return box;
  return {.u_min_px = std::min(box.u_min_px, static_cast<double>(mask.u_begin)),
          .v_min_px = std::min(box.v_min_px, static_cast<double>(mask.v_begin)),
          .u_max_px = std::max(box.u_max_px, static_cast<double>(mask.u_end)),
          .v_max_px = std::max(box.v_max_px, static_cast<double>(mask.v_end))};
}

MaskImage widened(const MaskImage& mask, int reach_px) {
  const auto width = static_cast<std::size_t>(mask.width_px());
  const auto height = static_cast<std::size_t>(mask.height_px());
  const auto reach = static_cast<std::size_t>(reach_px);
  MaskImage in_rows(mask.width_px(), mask.height_px());
  for (std::size_t v = 0; v < height; ++v) {
    widen_line(
        mask.pixels().data() + v * width, width, 1, reach, in_rows.pixels().data() + v * width);
  }
  MaskImage result(mask.width_px(), mask.height_px());
  for (std::size_t u = 0; u < width; ++u) {
    widen_line(in_rows.pixels().data() + u, height, width, reach, result.pixels().data() + u);
  }
  return result;
}

MaskImage widened_by_tolerance(const MaskImage& mask) {
  const double tolerance_px = mask_tolerance_px(mask.width_px(), mask.height_px());
  return widened(mask, static_cast<int>(std::ceil(tolerance_px)));
}

}  // namespace hypermap

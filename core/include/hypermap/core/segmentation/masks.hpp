// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What can be asked of a detector's masks.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <algorithm>

namespace hypermap {

/// Side of a cell of a segmentation network's mask in an image of that size. Networks take squares
/// of 640 pixels, mostly, into which the longer side is fitted, and make masks at a quarter of
/// that, so that a cell covers a 160th of that side: 4 pixels of 640. Unit: pixel.
[[nodiscard]] constexpr double mask_cell_px(int width_px, int height_px) noexcept {
  return std::max(width_px, height_px) / 160.0;
}

/// How far the edge of such a mask may be off: one and a half of its cells. Unit: pixel.
[[nodiscard]] constexpr double mask_tolerance_px(int width_px, int height_px) noexcept {
  return 1.5 * mask_cell_px(width_px, height_px);
}

/// The smallest rectangle around the pixels that are not 0; empty when all are.
/// Cost: O(pixels).
[[nodiscard]] PixelRect bounds_of(const MaskImage& mask);

/// The smallest box around a detection's box and its mask. Networks cut masks off at their box, and
/// boxes of files may be anything beside a mask.
[[nodiscard]] PixelBox box_with_mask(const Detection& detection);

/// 1 on the pixels within `reach_px` columns and rows of one that is not 0, else 0.
/// Requires: reach_px >= 0. Cost: O(pixels).
[[nodiscard]] MaskImage widened(const MaskImage& mask, int reach_px);

/// All that the mask may show: widened by as much as its edge may be off. Cost: O(pixels).
[[nodiscard]] MaskImage widened_by_tolerance(const MaskImage& mask);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where in a detection's box something is shown that the detection does not mean.
#pragma once

#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/detection.hpp"

namespace hypermap {

/// The part of an image that shows surfaces which run on beyond a detection's box: the wall behind
/// a bed, the top of the desk before a chair. In square cells of pixels. Ours.
struct BackgroundCells {
  PixelRect rect;           ///< What was looked at: the box and its surroundings. Unit: pixel.
  int block_px = 1;         ///< Edge of a cell; those at the right and lower edge may be cut off.
  MaskImage is_background;  ///< A pixel a cell. Empty: nothing is known.

  [[nodiscard]] bool contains(int u, int v) const {
    if (is_background.empty() || !rect.contains(u, v)) return false;
    return is_background.at((u - rect.u_begin) / block_px, (v - rect.v_begin) / block_px) != 0;
  }
  /// The same of the pixel and the four beside it: at a border, pixels are of either side.
  [[nodiscard]] bool surrounds(int u, int v) const {
    return contains(u, v) && contains(u - 1, v) && contains(u + 1, v) && contains(u, v - 1) &&
           contains(u, v + 1);
  }

  friend bool operator==(const BackgroundCells&, const BackgroundCells&) = default;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a network says of the pixels of one object, coarser or finer than the image.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "network_input.hpp"

#include <vector>

namespace hypermap {

/// Cells over a part of the input; a cell's number holds at its middle.
struct MaskGrid {
  PixelBox place_px;  ///< What the cells cover, in pixels of the input.
  int width = 0;      ///< Cells, above 0.
  int height = 0;
  std::vector<float> values;  ///< Row by row.
  double threshold = 0.5;     ///< Above it a pixel is the object's.
};

/// Whether all numbers are.
[[nodiscard]] bool is_finite(const MaskGrid& grid);

/// The pixels of an image whose middles lie in the box and whose value, between the cells around
/// it, is above the threshold. `box_px` is in the image. Cost: a look at each pixel of the box.
[[nodiscard]] MaskImage drawn(const MaskGrid& grid,
                              const PixelBox& box_px,
                              const InputPlacement& placement,
                              int image_width_px,
                              int image_height_px);

}  // namespace hypermap

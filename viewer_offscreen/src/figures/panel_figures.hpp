// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The panels of a depth image, over the image and from above.
#pragma once

#include "annotation/text_painter.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/segmentation/binned_depth_map.hpp"

namespace hypermap {

/// The frame's colour; without any, its depth, near bright, what is not measured black.
[[nodiscard]] ColorImage backdrop_of(const RgbdFrame& frame);

/// Requires: `backdrop` is of the frame that the panels are of.
[[nodiscard]] ColorImage draw_panels(const ColorImage& backdrop,
                                     const BinnedDepthMap& panels,
                                     const TextPainter& painter);

[[nodiscard]] ColorImage draw_panels_from_above(const BinnedDepthMap& panels,
                                                const TextPainter& painter);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Areas and their outlines in pixels.
#pragma once

#include "hypermap/core/base/image.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace hypermap {

/// Closed rings in pixels; those within others are holes.
using PixelShape = std::vector<std::vector<Eigen::Vector2d>>;

enum class StrokeStyle : std::uint8_t { kSolid, kDashed };

/// Fills what an odd number of rings surrounds, blended by `opacity`.
void fill_shape(ColorImage& image, const PixelShape& shape, Rgb8 color, double opacity);
/// Draws all rings.
void stroke_shape(
    ColorImage& image, const PixelShape& shape, double width_px, Rgb8 color, StrokeStyle style);

}  // namespace hypermap

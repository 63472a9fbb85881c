// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Grids as textures: a pixel for each cell, or for several where a texture cannot be so large.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"
#include "hypermap/projection/layers/layer_drawing.hpp"

#include <cstdint>

namespace hypermap {

/// Colours of an occupancy grid's cells: dark where occupied, white where free.
[[nodiscard]] Rgb8 occupancy_color(std::int8_t occupancy);

/// Of merged cells the fullest counts. Requires: largest_side_px > 0.
[[nodiscard]] ColorImage texture_of(const OccupancyGrid& grid, int largest_side_px);
/// Of merged cells the first counts. Requires: largest_side_px > 0.
[[nodiscard]] ColorImage texture_of(const DrawnCells& cells, int largest_side_px);

}  // namespace hypermap

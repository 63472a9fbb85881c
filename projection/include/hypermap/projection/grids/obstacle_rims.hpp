// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is left of obstacles that were taken out of a grid.
#pragma once

#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <span>

namespace hypermap {

/// The grid without the rims that obstacles leave where `without_obstacles` has freed the cells
/// that they cover by half; walls beside them stay.
///
/// Free becomes an occupied cell (50 on) that an obstacle meets, unless one of its eight neighbours
/// that none meets is occupied or unknown, as behind a wall; then what of the occupied cells hangs
/// together by such neighbours, when each of them is met or has a neighbour that is, and none has
/// an unknown one.
///
/// Source: [smap] F.6 (occupancy grid with the obstacles removed).
/// Frame: of the polygons that of the grid. Boundary: beyond the grid is unknown.
/// Cost: as for_each_covered_cell, and O(cells).
[[nodiscard]] OccupancyGrid without_rims(OccupancyGrid grid, std::span<const Polygon> obstacles);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Part of an occupancy grid.
#pragma once

#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace hypermap {

/// The cells whose centres `is_inside` accepts, in the smallest grid that holds them; what else
/// lies in that is unknown. Cells stay where they are. Boundary: without such a cell the first one
/// alone, unknown; a grid without cells stays. Frame: the grid's. Cost: a question for each cell.
[[nodiscard]] OccupancyGrid cropped(const OccupancyGrid& grid,
                                    const std::function<bool(const Eigen::Vector2d&)>& is_inside);

/// The cells whose interior the area meets, as spatial queries take them, in the smallest grid that
/// holds them; what else lies in that is unknown. Cells stay where they are. None where the area
/// meets no cell. Frame: the grid's. Cost: of for_each_covered_cell.
[[nodiscard]] std::optional<OccupancyGrid> sub_map(const OccupancyGrid& grid, const Polygon& area);

}  // namespace hypermap

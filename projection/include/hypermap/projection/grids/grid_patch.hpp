// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A smaller grid that takes the place of some cells of a larger one.
///
/// Source: [hypermap] 3.3.4 (updates of a layer); ROS map_msgs/OccupancyGridUpdate.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

namespace hypermap {

/// Which cell of `whole` the first cell of `part` is.
///
/// Errors: kInvalidArgument naming the field of the part: a resolution or a yaw by which its far
/// corner would lie more than a thousandth of a cell off, an origin that is no whole number of
/// cells away from the other one within as much, a part that reaches beyond the bounds, or one
/// without cells.
[[nodiscard]] Result<Cell> first_cell_of_part(const GridGeometry& whole, const GridGeometry& part);

/// The grid with the cells of the part in their places, unknown ones too. Its geometry stays.
/// Errors: those of first_cell_of_part. Cost: linear in the part, and a copy unless `grid` is
/// moved.
[[nodiscard]] Result<OccupancyGrid> patched(OccupancyGrid grid, const OccupancyGrid& part);

}  // namespace hypermap

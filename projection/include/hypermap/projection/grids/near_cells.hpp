// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which cells of a grid lie within a distance of shapes.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"

#include <functional>
#include <span>

namespace hypermap {

/// Called with a cell and its gap to the shapes, in cells.
using NearCellVisitor = std::function<void(Cell, double gap_cells)>;

/// Visits the cells of the grid whose gap to the polygons is at most `reach_cells`, row by row from
/// row 0, columns ascending, whatever the grid's yaw.
///
/// The gap of a cell is the way from its middle to the nearest edge of a cell that a polygon meets
/// (`for_each_covered_cell`), as the line between their middles goes, less half a cell; of a cell
/// that one meets -0.5. Polygons beyond the grid count. Exact to one cell.
///
/// Frame: the grid's. Requires: 0 <= reach_cells <= 1e9. Errors: kLimit when the cells around
/// the polygons would be more than a grid may have.
/// Source: P. Felzenszwalb and D. Huttenlocher, "Distance Transforms of Sampled Functions", 2012.
/// Cost: the cells of the rectangle around the polygons, `reach_cells` wider, within that around
/// the grid; 9 bytes for each.
[[nodiscard]] Result<void> for_each_near_cell(const GridGeometry& grid,
                                              std::span<const Polygon> polygons,
                                              double reach_cells,
                                              const NearCellVisitor& visit);

}  // namespace hypermap

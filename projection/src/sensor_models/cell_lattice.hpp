// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Grids whose cells' edges lie at whole multiples of their resolution from the map's origin.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

namespace hypermap {

/// The smallest one that holds all points of the closed rectangle: at least one cell.
/// Errors: those of validate(GridGeometry).
[[nodiscard]] Result<GridGeometry> lattice_around(const Rect& rect, double resolution_m);

/// The part of an unturned grid around its known cells; its middle cell when it knows none.
/// Errors: kOutOfMemory. Requires: the grid has cells.
[[nodiscard]] Result<LogOddsGrid> cropped_to_known(const LogOddsGrid& grid);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The grid that parts were cut from (cropped_grid.hpp).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <span>

namespace hypermap {

/// The smallest grid that holds the cells of all parts; what no part knows is unknown. Boundary: no
/// parts, a grid without cells. Frame: that of all.
/// Errors: kInvalidArgument for a part of another resolution, turn or lattice than the first (by
/// more than a thousandth of a cell), and for a cell that two parts know; kLimit for a grid that is
/// too large. Cost: the cells of the parts and of the result.
[[nodiscard]] Result<OccupancyGrid> joined(std::span<const OccupancyGrid> parts);

}  // namespace hypermap

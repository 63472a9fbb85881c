// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/grid_patch.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace hypermap {
namespace {

/// Files of others give origins with few digits.
constexpr double kLatticeSlackCells = 1e-3;

Unexpected does_not_fit(std::string what, std::string field) {
  return fail(ErrorCode::kInvalidArgument, std::move(what), std::move(field));
}

std::string differs(double part, double whole, const std::string& unit) {
  return "is " + number_text(part) + unit + ", that of the layer " + number_text(whole) + unit;
}

Result<void> check_lattice(const GridGeometry& whole, const GridGeometry& part) {
  if (part.num_cells() == 0) return does_not_fit("has no cells", "image");
  const double longest = std::max(part.cols, part.rows);
  const double stretch = std::abs(part.resolution_m / whole.resolution_m - 1.0);
  if (stretch * longest > kLatticeSlackCells)
    return does_not_fit(differs(part.resolution_m, whole.resolution_m, " m"), "resolution");
  const double turn_rad = std::remainder(part.yaw_rad - whole.yaw_rad, 2.0 * std::numbers::pi);
  if (std::abs(turn_rad) * longest > kLatticeSlackCells)
    return does_not_fit(differs(part.yaw_rad, whole.yaw_rad, " rad"), "yaw");
  return {};
}

/// "cells 3 to 7, the layer has 0 to 5".
std::string beyond(const char* axis, int first, int count, int limit) {
  return std::string("reaches from ") + axis + " " + std::to_string(first) + " to " +
         std::to_string(static_cast<std::int64_t>(first) + count - 1) + ", the layer has 0 to " +
         std::to_string(limit - 1);
}

}  // namespace

Result<Cell> first_cell_of_part(const GridGeometry& whole, const GridGeometry& part) {
  HYPERMAP_TRY(check_lattice(whole, part));
  const Eigen::Vector2d cells = to_cells(whole, part.origin);
  const Eigen::Vector2d nearest = cells.array().round();
  if ((cells - nearest).cwiseAbs().maxCoeff() > kLatticeSlackCells) {
    return does_not_fit("lies " + number_text(cells.x()) + ", " + number_text(cells.y()) +
                            " cells from that of the layer, must be whole ones",
                        "origin");
  }
  constexpr double kFar = 1e9;  // within int; no grid is as large
  if (nearest.cwiseAbs().maxCoeff() > kFar) return does_not_fit("lies beyond the layer", "origin");
  const Cell first{.col = static_cast<int>(nearest.x()), .row = static_cast<int>(nearest.y())};
  if (first.col < 0 || first.col > whole.cols - part.cols)
    return does_not_fit(beyond("column", first.col, part.cols, whole.cols), "bounds");
  if (first.row < 0 || first.row > whole.rows - part.rows)
    return does_not_fit(beyond("row", first.row, part.rows, whole.rows), "bounds");
  return first;
}

Result<OccupancyGrid> patched(OccupancyGrid grid, const OccupancyGrid& part) {
  HYPERMAP_ASSIGN_OR_RETURN(const Cell first, first_cell_of_part(grid.geometry(), part.geometry()));
  for (int row = 0; row < part.geometry().rows; ++row) {
    for (int col = 0; col < part.geometry().cols; ++col) {
      grid.set({.col = first.col + col, .row = first.row + row}, part.at({.col = col, .row = row}));
    }
  }
  return grid;
}

}  // namespace hypermap

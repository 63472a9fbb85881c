// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/joined_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Of a cell: parts that were saved have origins rounded to what their files hold.
constexpr double kLatticeTolerance = 1e-3;

Unexpected no_part(const char* what) {
  return fail(ErrorCode::kInvalidArgument, what, "grid");
}

/// Where a part's first cell lies among those of the first part.
Result<Cell> first_cell(const GridGeometry& lattice, const GridGeometry& part) {
  if (part.resolution_m != lattice.resolution_m || part.yaw_rad != lattice.yaw_rad) {
    return no_part("must have the resolution and turn of the other parts");
  }
  const Eigen::Vector2d corner = to_cells(lattice, part.origin);
  const Eigen::Vector2d whole = corner.array().round();
  if ((corner - whole).cwiseAbs().maxCoeff() > kLatticeTolerance) {
    return no_part("must lie on the lattice of the other parts");
  }
  constexpr double kFarCells = 5e8;  // sums of two stay within int; no grid is as large
  if (whole.cwiseAbs().maxCoeff() > kFarCells) {
    return fail(ErrorCode::kLimit, "parts lie too far from each other for one grid", "grid");
  }
  return Cell{.col = static_cast<int>(whole.x()), .row = static_cast<int>(whole.y())};
}

/// The known cells of a part, whose first cell is `at`. Errors: kInvalidArgument.
Result<void> put_cells(std::vector<std::int8_t>& cells,
                       const GridGeometry& whole,
                       const OccupancyGrid& part,
                       Cell at) {
  const GridGeometry& geometry = part.geometry();
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const std::int8_t value = part.at({.col = col, .row = row});
      if (value == kUnknownCell) continue;
      std::int8_t& cell = cells[whole.index({.col = at.col + col, .row = at.row + row})];
      if (cell != kUnknownCell) return no_part("has a cell that another part knows");
      cell = value;
    }
  }
  return {};
}

}  // namespace

Result<OccupancyGrid> joined(std::span<const OccupancyGrid> parts) {
  if (parts.empty()) return OccupancyGrid();
  const GridGeometry& lattice = parts.front().geometry();
  std::vector<Cell> corners;
  corners.reserve(parts.size());
  Cell low{};
  Cell high{};
  for (const OccupancyGrid& part : parts) {
    HYPERMAP_ASSIGN_OR_RETURN(const Cell at, first_cell(lattice, part.geometry()));
    corners.push_back(at);
    low = {.col = std::min(low.col, at.col), .row = std::min(low.row, at.row)};
    high = {.col = std::max(high.col, at.col + part.geometry().cols),
            .row = std::max(high.row, at.row + part.geometry().rows)};
  }
  GridGeometry whole = lattice;
  whole.origin = from_cells(lattice, {low.col, low.row});
  whole.cols = high.col - low.col;
  whole.rows = high.row - low.row;
  HYPERMAP_TRY(validate(whole));
  std::vector<std::int8_t> cells(whole.num_cells(), kUnknownCell);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Cell at{.col = corners[i].col - low.col, .row = corners[i].row - low.row};
    HYPERMAP_TRY(put_cells(cells, whole, parts[i], at));
  }
  return OccupancyGrid::create(whole, std::move(cells));
}

}  // namespace hypermap

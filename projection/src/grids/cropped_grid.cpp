// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/cropped_grid.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// The smallest grid that holds these cells of the other; all else in it is unknown.
/// Requires: at least one cell.
OccupancyGrid grid_of_cells(const OccupancyGrid& grid, const std::vector<Cell>& cells) {
  Cell first = cells.front();
  Cell last = cells.front();
  for (const Cell& cell : cells) {
    first = {.col = std::min(first.col, cell.col), .row = std::min(first.row, cell.row)};
    last = {.col = std::max(last.col, cell.col), .row = std::max(last.row, cell.row)};
  }
  GridGeometry part = grid.geometry();
  part.origin = from_cells(grid.geometry(), {first.col, first.row});
  part.cols = last.col - first.col + 1;
  part.rows = last.row - first.row + 1;
  std::vector<std::int8_t> values(part.num_cells(), kUnknownCell);
  for (const Cell& cell : cells) {
    const Cell moved{.col = cell.col - first.col, .row = cell.row - first.row};
    values[part.index(moved)] = grid.at(cell);
  }
  // Invariant: a part of a valid grid is one.
  return OccupancyGrid::create(part, std::move(values)).value();
}

}  // namespace

OccupancyGrid cropped(const OccupancyGrid& grid,
                      const std::function<bool(const Eigen::Vector2d&)>& is_inside) {
  const GridGeometry& whole = grid.geometry();
  if (whole.num_cells() == 0) return grid;
  std::vector<Cell> inside;
  for (int row = 0; row < whole.rows; ++row) {
    for (int col = 0; col < whole.cols; ++col) {
      const Cell cell{.col = col, .row = row};
      if (is_inside(centre(whole, cell))) inside.push_back(cell);
    }
  }
  if (!inside.empty()) return grid_of_cells(grid, inside);
  OccupancyGrid first = grid_of_cells(grid, {Cell{}});
  first.set(Cell{}, kUnknownCell);
  return first;
}

std::optional<OccupancyGrid> sub_map(const OccupancyGrid& grid, const Polygon& area) {
  std::vector<Cell> met;
  for_each_covered_cell(
      grid.geometry(), area, [&](Cell cell, double /*covered*/) { met.push_back(cell); });
  if (met.empty()) return std::nullopt;
  return grid_of_cells(grid, met);
}

}  // namespace hypermap

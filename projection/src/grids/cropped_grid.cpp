// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/cropped_grid.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace hypermap {

OccupancyGrid cropped(const OccupancyGrid& grid,
                      const std::function<bool(const Eigen::Vector2d&)>& is_inside) {
  const GridGeometry& whole = grid.geometry();
  std::vector<Cell> inside;
  Cell first{.col = whole.cols, .row = whole.rows};
  Cell last{.col = -1, .row = -1};
  for (int row = 0; row < whole.rows; ++row) {
    for (int col = 0; col < whole.cols; ++col) {
      const Cell cell{.col = col, .row = row};
      if (!is_inside(centre(whole, cell))) continue;
      inside.push_back(cell);
      first = {.col = std::min(first.col, col), .row = std::min(first.row, row)};
      last = {.col = std::max(last.col, col), .row = std::max(last.row, row)};
    }
  }
  if (whole.num_cells() == 0) return grid;
  if (inside.empty()) first = last = Cell{};
  GridGeometry part = whole;
  part.origin = from_cells(whole, {first.col, first.row});
  part.cols = last.col - first.col + 1;
  part.rows = last.row - first.row + 1;
  std::vector<std::int8_t> cells(part.num_cells(), kUnknownCell);
  for (const Cell& cell : inside) {
    const Cell moved{.col = cell.col - first.col, .row = cell.row - first.row};
    cells[part.index(moved)] = grid.at(cell);
  }
  // Invariant: a part of a valid grid is one.
  return OccupancyGrid::create(part, std::move(cells)).value();
}

}  // namespace hypermap

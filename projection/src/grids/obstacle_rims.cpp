// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/obstacle_rims.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// The grid with, of each cell, whether an obstacle meets it.
struct MetGrid {
  OccupancyGrid grid;
  std::vector<std::uint8_t> is_met;

  [[nodiscard]] bool is_occupied(Cell cell) const { return grid.at(cell) >= kLeastBlocked; }
  /// What is beyond the grid, too.
  [[nodiscard]] bool is_unknown(Cell cell) const {
    return !grid.geometry().contains(cell) || grid.at(cell) == kUnknownCell;
  }
  /// Requires: the cell is in the grid.
  [[nodiscard]] bool meets(Cell cell) const { return is_met[grid.geometry().index(cell)] != 0; }
};

MetGrid with_met_cells(OccupancyGrid grid, std::span<const Polygon> obstacles) {
  std::vector<std::uint8_t> is_met(grid.geometry().num_cells(), 0);
  for (const Polygon& obstacle : obstacles) {
    for_each_covered_cell(grid.geometry(), obstacle, [&](Cell cell, double) {
      is_met[grid.geometry().index(cell)] = 1;
    });
  }
  return {std::move(grid), std::move(is_met)};
}

/// The eight neighbours, which may lie beyond the grid.
template <class Visit>
void for_each_around(Cell cell, const Visit& visit) {
  for (int row = cell.row - 1; row <= cell.row + 1; ++row) {
    for (int col = cell.col - 1; col <= cell.col + 1; ++col) {
      const Cell other{col, row};
      if (other != cell) visit(other);
    }
  }
}

template <class Holds>
bool any_around(Cell cell, const Holds& holds) {
  bool any = false;
  for_each_around(cell, [&](Cell other) { any = any || holds(other); });
  return any;
}

template <class Visit>
void for_each_cell_of(const GridGeometry& geometry, const Visit& visit) {
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) visit(Cell{col, row});
  }
}

/// Occupied cells that an obstacle meets and that no wall lies beside.
std::vector<Cell> rim_cells(const MetGrid& met) {
  const GridGeometry& geometry = met.grid.geometry();
  const auto is_wall_or_unknown = [&](Cell cell) {
    if (!geometry.contains(cell)) return true;
    return !met.meets(cell) && (met.is_occupied(cell) || met.is_unknown(cell));
  };
  std::vector<Cell> rims;
  for_each_cell_of(geometry, [&](Cell cell) {
    if (!met.is_occupied(cell) || !met.meets(cell)) return;
    if (!any_around(cell, is_wall_or_unknown)) rims.push_back(cell);
  });
  return rims;
}

bool is_beside_obstacle(const MetGrid& met, Cell cell) {
  const auto meets = [&](Cell other) {
    return met.grid.geometry().contains(other) && met.meets(other);
  };
  return met.meets(cell) || any_around(cell, meets);
}

/// Whether a cell may be what is left of an obstacle: beside one, and not beside what nobody saw.
bool may_be_left_over(const MetGrid& met, Cell cell) {
  return is_beside_obstacle(met, cell) &&
         !any_around(cell, [&](Cell other) { return met.is_unknown(other); });
}

/// The occupied cells of a grid, piece by piece.
class OccupiedPieces {
 public:
  explicit OccupiedPieces(const MetGrid& met)
      : met_(met), is_seen_(met.grid.geometry().num_cells(), 0) {}

  /// All that hang together with `first`; none when it is free or of an earlier piece.
  std::vector<Cell> piece_from(Cell first) {
    std::vector<Cell> piece;
    const auto add = [&](Cell cell) {
      if (!is_new(cell)) return;
      is_seen_[met_.grid.geometry().index(cell)] = 1;
      piece.push_back(cell);
    };
    add(first);
    for (std::size_t i = 0; i < piece.size(); ++i) for_each_around(piece[i], add);
    return piece;
  }

 private:
  [[nodiscard]] bool is_new(Cell cell) const {
    const GridGeometry& geometry = met_.grid.geometry();
    return geometry.contains(cell) && met_.is_occupied(cell) && is_seen_[geometry.index(cell)] == 0;
  }

  const MetGrid& met_;
  std::vector<std::uint8_t> is_seen_;
};

/// Cells of pieces that are left over as a whole.
std::vector<Cell> cells_of_crumbs(const MetGrid& met) {
  OccupiedPieces pieces(met);
  std::vector<Cell> crumbs;
  for_each_cell_of(met.grid.geometry(), [&](Cell cell) {
    const std::vector<Cell> piece = pieces.piece_from(cell);
    const bool is_crumb =
        std::ranges::all_of(piece, [&](Cell one) { return may_be_left_over(met, one); });
    if (is_crumb) crumbs.insert(crumbs.end(), piece.begin(), piece.end());
  });
  return crumbs;
}

}  // namespace

OccupancyGrid without_rims(OccupancyGrid grid, std::span<const Polygon> obstacles) {
  MetGrid met = with_met_cells(std::move(grid), obstacles);
  for (const Cell cell : rim_cells(met)) met.grid.set(cell, kFreeCell);
  for (const Cell cell : cells_of_crumbs(met)) met.grid.set(cell, kFreeCell);
  return std::move(met.grid);
}

}  // namespace hypermap

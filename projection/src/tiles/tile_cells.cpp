// SPDX-License-Identifier: BSD-3-Clause
#include "tile_cells.hpp"

#include <cmath>
#include <utility>

namespace hypermap {
namespace {

constexpr double kWholeCell = 1e-6;
constexpr double kFarthestCell = 1e15;

/// The cells of `geometry`, whose first one is cell `first` of the layer.
Result<LogOddsGrid> part_of(const LogOddsGrid& layer, const GridGeometry& geometry, Cell first) {
  HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid part, LogOddsGrid::create(geometry));
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const Cell cell{first.col + col, first.row + row};
      if (layer.geometry().contains(cell)) part.set({col, row}, layer.at(cell));
    }
  }
  return part;
}

}  // namespace

LatticeCell first_cell(TileIndex tile, const TileLattice& lattice) {
  return {std::int64_t{tile.col} * lattice.tile_cells, std::int64_t{tile.row} * lattice.tile_cells};
}

std::optional<LatticeCell> first_cell(const GridGeometry& grid, const TileLattice& lattice) {
  if (grid.resolution_m != lattice.resolution_m || grid.yaw_rad != 0.0) return std::nullopt;
  const Eigen::Vector2d cells = grid.origin / lattice.resolution_m;
  const Eigen::Vector2d whole = cells.array().round();
  const bool fits = (cells - whole).cwiseAbs().maxCoeff() <= kWholeCell &&
                    whole.cwiseAbs().maxCoeff() <= kFarthestCell;
  if (!fits) return std::nullopt;
  return LatticeCell{static_cast<std::int64_t>(whole.x()), static_cast<std::int64_t>(whole.y())};
}

Cell cell_from(const LatticeCell& from, const LatticeCell& to) {
  return {static_cast<int>(to.col - from.col), static_cast<int>(to.row - from.row)};
}

Result<StackTile> tile_of(const GridStack& stack,
                          const LatticeCell& first,
                          TileIndex index,
                          const TileLattice& lattice) {
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, geometry_of(lattice, {.first = index}));
  const Cell place = cell_from(first, first_cell(index, lattice));
  StackTile tile{.index = index};
  for (const auto& [name, layer] : stack.layers()) {
    HYPERMAP_ASSIGN_OR_RETURN(LogOddsGrid part, part_of(layer, geometry, place));
    if (part.num_known() > 0) tile.layers.emplace(name, std::move(part));
  }
  return tile;
}

Result<void> place_tile(const StackTile& tile,
                        const LatticeCell& first,
                        const TileLattice& lattice,
                        GridStack& stack) {
  const Cell place = cell_from(first, first_cell(tile.index, lattice));
  for (const auto& [name, grid] : tile.layers) {
    HYPERMAP_TRY(stack.replace_cells(name, grid, place));
  }
  return {};
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/stored_map.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "tile_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Cells from `first` to before `end`.
struct LatticeWindow {
  LatticeCell first;
  LatticeCell end;
};

/// What reaches by less than this part into a cell does not meet it.
constexpr double kSlack = 1e-6;
/// Cells are counted so far.
constexpr double kFarthest = 1e15;

LatticeWindow cells_of(TileIndex tile, const TileLattice& lattice) {
  const LatticeCell first = first_cell(tile, lattice);
  return {first, {first.col + lattice.tile_cells, first.row + lattice.tile_cells}};
}

bool meet(const LatticeWindow& a, const LatticeWindow& b) {
  return a.first.col < b.end.col && b.first.col < a.end.col && a.first.row < b.end.row &&
         b.first.row < a.end.row;
}

Result<LatticeWindow> cells_of(const Rect& area, const TileLattice& lattice) {
  const Eigen::Vector2d first =
      ((area.min / lattice.resolution_m).array() + kSlack).floor().matrix();
  const Eigen::Vector2d end = ((area.max / lattice.resolution_m).array() - kSlack).ceil().matrix();
  const bool is_rect =
      area.min.allFinite() && area.max.allFinite() && (end - first).minCoeff() >= 1.0 &&
      first.cwiseAbs().maxCoeff() <= kFarthest && end.cwiseAbs().maxCoeff() <= kFarthest;
  if (!is_rect) {
    return fail(ErrorCode::kInvalidArgument, "must be finite and have an inside", "area");
  }
  return LatticeWindow{{static_cast<std::int64_t>(first.x()), static_cast<std::int64_t>(first.y())},
                       {static_cast<std::int64_t>(end.x()), static_cast<std::int64_t>(end.y())}};
}

LatticeWindow around(const LatticeWindow& a, const LatticeWindow& b) {
  return {{std::min(a.first.col, b.first.col), std::min(a.first.row, b.first.row)},
          {std::max(a.end.col, b.end.col), std::max(a.end.row, b.end.row)}};
}

Result<GridGeometry> geometry_of_cells(const LatticeWindow& window, const TileLattice& lattice) {
  const auto side = [](std::int64_t cells) {
    return static_cast<int>(std::min<std::int64_t>(cells, std::numeric_limits<int>::max()));
  };
  const GridGeometry geometry{
      .resolution_m = lattice.resolution_m,
      .origin = {static_cast<double>(window.first.col) * lattice.resolution_m,
                 static_cast<double>(window.first.row) * lattice.resolution_m},
      .cols = side(window.end.col - window.first.col),
      .rows = side(window.end.row - window.first.row)};
  HYPERMAP_TRY(validate(geometry));
  return geometry;
}

/// The tiles that meet the window; all without one.
Result<std::vector<TileIndex>> tiles_in(const TileStore& store,
                                        const std::optional<LatticeWindow>& window) {
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<TileIndex> tiles, store.list());
  if (window) {
    std::erase_if(tiles,
                  [&](TileIndex tile) { return !meet(cells_of(tile, store.lattice()), *window); });
  }
  if (!tiles.empty()) return tiles;
  return fail(ErrorCode::kNotFound, window ? "no tile lies in the area" : "there are no tiles");
}

/// The tiles that meet the stack.
Result<TileWindow> window_of_stack(const GridStack& stack,
                                   const LatticeCell& first,
                                   const TileLattice& lattice) {
  const auto tile_of_cell = [&](std::int64_t cell) {
    const std::int64_t side = lattice.tile_cells;
    return cell >= 0 ? cell / side : -((-cell + side - 1) / side);
  };
  const std::int64_t col = tile_of_cell(first.col);
  const std::int64_t row = tile_of_cell(first.row);
  constexpr std::int64_t kFarthestTile = 1'000'000'000;
  if (std::max(std::abs(col), std::abs(row)) > kFarthestTile) {
    return fail(ErrorCode::kLimit, "lies more than 10^9 tiles from the origin", "stack");
  }
  const GridGeometry& grid = stack.geometry();
  return TileWindow{.first = {static_cast<std::int32_t>(col), static_cast<std::int32_t>(row)},
                    .cols = static_cast<int>(tile_of_cell(first.col + grid.cols - 1) - col + 1),
                    .rows = static_cast<int>(tile_of_cell(first.row + grid.rows - 1) - row + 1)};
}

}  // namespace

Result<GridStack> stack_of_tiles(const TileStore& store,
                                 const std::optional<Rect>& area,
                                 GridStackOptions options) {
  const TileLattice& lattice = store.lattice();
  HYPERMAP_TRY(validate(lattice));
  std::optional<LatticeWindow> window;
  if (area) {
    HYPERMAP_ASSIGN_OR_RETURN(window, cells_of(*area, lattice));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<TileIndex> tiles, tiles_in(store, window));
  if (!window) {
    window = cells_of(tiles.front(), lattice);
    for (const TileIndex tile : tiles) window = around(*window, cells_of(tile, lattice));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry, geometry_of_cells(*window, lattice));
  options.frame_id = lattice.frame_id;
  HYPERMAP_ASSIGN_OR_RETURN(GridStack stack, GridStack::create(geometry, std::move(options)));
  for (const TileIndex index : tiles) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto tile, store.get(index));
    if (tile) HYPERMAP_TRY(place_tile(*tile, window->first, lattice, stack));
  }
  return stack;
}

Result<std::size_t> store_stack(const GridStack& stack,
                                TileStore& store,
                                const std::optional<GeographicDatum>& map_datum) {
  const TileLattice& lattice = store.lattice();
  HYPERMAP_TRY(validate(lattice));
  if (map_datum) HYPERMAP_TRY(validate(*map_datum));
  if (stack.options().frame_id != lattice.frame_id) {
    return fail(ErrorCode::kInvalidArgument,
                "must be '" + printable(lattice.frame_id) + "', the tiles' frame, is '" +
                    printable(stack.options().frame_id) + "'",
                "frame_id");
  }
  const auto first = first_cell(stack.geometry(), lattice);
  if (!first) {
    return fail(ErrorCode::kInvalidArgument,
                "must have cells of " + number_text(lattice.resolution_m) +
                    " m, unturned, at whole multiples of it",
                "stack");
  }
  HYPERMAP_ASSIGN_OR_RETURN(const TileWindow window, window_of_stack(stack, *first, lattice));
  std::size_t num_stored = 0;
  for (int row = 0; row < window.rows; ++row) {
    for (int col = 0; col < window.cols; ++col) {
      const TileIndex index{window.first.col + col, window.first.row + row};
      HYPERMAP_ASSIGN_OR_RETURN(StackTile tile, tile_of(stack, *first, index, lattice));
      if (tile.layers.empty()) continue;
      if (map_datum) {
        HYPERMAP_ASSIGN_OR_RETURN(const auto cells, geometry_of(lattice, {.first = index}));
        tile.datum = shifted(*map_datum, cells.origin);
      }
      HYPERMAP_TRY(store.put(tile));
      ++num_stored;
    }
  }
  return num_stored;
}

}  // namespace hypermap

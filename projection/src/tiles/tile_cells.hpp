// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Cells of a stack as tiles.
#pragma once

#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/tiles/tile_store.hpp"

#include <cstdint>
#include <optional>

namespace hypermap {

/// A cell of a lattice by how many cells it lies from the origin.
struct LatticeCell {
  std::int64_t col = 0;
  std::int64_t row = 0;
  friend bool operator==(const LatticeCell&, const LatticeCell&) = default;
};

/// The lower-left cell of a tile.
[[nodiscard]] LatticeCell first_cell(TileIndex tile, const TileLattice& lattice);

/// Which cell of the lattice the first one of a grid is; none when its cells are not those of the
/// lattice: of another size, turned, or between them by more than a millionth.
[[nodiscard]] std::optional<LatticeCell> first_cell(const GridGeometry& grid,
                                                    const TileLattice& lattice);

/// `to` as a cell of a grid whose first cell is `from`.
/// Requires: fewer than 2^31 cells lie between them.
[[nodiscard]] Cell cell_from(const LatticeCell& from, const LatticeCell& to);

/// A tile of a stack whose first cell is `first`. Layers that know nothing of the tile are left
/// out; cells outside the stack are unknown. Errors: those of geometry_of; kOutOfMemory.
[[nodiscard]] Result<StackTile> tile_of(const GridStack& stack,
                                        const LatticeCell& first,
                                        TileIndex index,
                                        const TileLattice& lattice);

/// Puts all layers of a tile into a stack whose first cell is `first`.
/// Errors: those of GridStack::replace_cells; layers before the one that fails are in it then.
[[nodiscard]] Result<void> place_tile(const StackTile& tile,
                                      const LatticeCell& first,
                                      const TileLattice& lattice,
                                      GridStack& stack);

}  // namespace hypermap

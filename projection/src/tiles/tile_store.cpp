// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/tile_store.hpp"

namespace hypermap {

Result<void> validate(const StackTile& tile, const TileLattice& lattice) {
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            geometry_of(lattice, {.first = tile.index}));
  for (const auto& [name, grid] : tile.layers) {
    if (grid.geometry() == geometry) continue;
    return fail(ErrorCode::kInvalidArgument,
                "layer '" + printable(name) + "' has other cells than tile " +
                    std::to_string(tile.index.col) + ", " + std::to_string(tile.index.row),
                "layers");
  }
  return tile.datum ? validate(*tile.datum) : Result<void>();
}

}  // namespace hypermap

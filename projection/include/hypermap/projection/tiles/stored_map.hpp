// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tiles as one map, and a map as tiles.
///
/// Source: [sogm] III-E (what is stored, for postprocessing).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/tiles/geographic_datum.hpp"
#include "hypermap/projection/tiles/tile_store.hpp"

#include <cstddef>
#include <optional>

namespace hypermap {

/// The tiles of an area as one stack; of all tiles when no area is given.
///
/// The stack has the cells that meet the area, or those of the smallest rectangle around all
/// tiles; what no tile knows is unknown. Its frame is the lattice's. Errors: kNotFound when no tile
/// lies there; kInvalidArgument for an area that is not finite or has no inside; kLimit for more
/// cells than a grid or a stack may have, telling both; those of GridStack::replace_cells for a
/// layer or evidence that `options` do not allow; those of the store. Cost: one tile in memory
/// beside the stack.
[[nodiscard]] Result<GridStack> stack_of_tiles(const TileStore& store,
                                               const std::optional<Rect>& area = {},
                                               GridStackOptions options = {});

/// Puts a stack into a store, each tile that it knows something of; gives their number. A tile that
/// is there already is replaced, also where the stack ends within it. `map_datum` is that of the
/// frame's origin. Errors: kInvalidArgument when the stack's frame or cells are not those of the
/// lattice; those of TileStore::put: then some tiles may be put.
[[nodiscard]] Result<std::size_t> store_stack(const GridStack& stack,
                                              TileStore& store,
                                              const std::optional<GeographicDatum>& map_datum = {});

}  // namespace hypermap

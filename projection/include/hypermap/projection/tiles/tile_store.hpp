// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where tiles lie that are not in memory.
///
/// Source: [sogm] III-E (permanent storage, tagged with content, resolution and location).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/stack/grid_stack.hpp"
#include "hypermap/projection/tiles/geographic_datum.hpp"
#include "hypermap/projection/tiles/tile_lattice.hpp"

#include <optional>
#include <vector>

namespace hypermap {

/// What is known of the cells of one tile, by layer.
struct StackTile {
  TileIndex index = {};
  GridStack::Layers layers = {};  ///< Each on the cells of the tile.
  /// Of its lower-left corner, when it is known where on Earth the map lies.
  std::optional<GeographicDatum> datum = {};
  friend bool operator==(const StackTile&, const StackTile&) = default;
};

/// Errors: kInvalidArgument when a layer does not have the cells of the tile, or the datum is none.
[[nodiscard]] Result<void> validate(const StackTile& tile, const TileLattice& lattice);

/// Keeps tiles of one lattice. Plugged by whoever keeps them elsewhere than `TileFolder`.
///
/// Threads: `get` and `list` may be called while any thread or process puts tiles: each answer has
/// a tile as it was before or after, whole.
class TileStore {
 public:
  virtual ~TileStore() = default;

  [[nodiscard]] virtual const TileLattice& lattice() const = 0;
  /// Keeps the tile in the place of an older one. Errors: those of validate(StackTile); kIo,
  /// kLimit; then the older one is as it was.
  [[nodiscard]] virtual Result<void> put(const StackTile& tile) = 0;
  /// None when there is no such tile. Errors: kMalformedFile, kLimit, kIo, kOutOfMemory.
  [[nodiscard]] virtual Result<std::optional<StackTile>> get(TileIndex index) const = 0;
  /// Of all tiles, ascending. With `get` for one after the other a map of any size can be read.
  /// Errors: kIo.
  [[nodiscard]] virtual Result<std::vector<TileIndex>> list() const = 0;

 protected:
  TileStore() = default;
  TileStore(const TileStore&) = default;
  TileStore(TileStore&&) = default;
  TileStore& operator=(const TileStore&) = default;
  TileStore& operator=(TileStore&&) = default;
};

}  // namespace hypermap

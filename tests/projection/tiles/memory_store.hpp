// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tiles in memory, and a store that fails when it is told to.
#pragma once

#include "hypermap/projection/tiles/tile_store.hpp"

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap::test {

/// Tiles of 1 m with 10 x 10 cells.
inline TileLattice metre_tiles() {
  return {.resolution_m = 0.1, .tile_cells = 10};
}

/// What a store holds and did; outlives it.
struct StoredTiles {
  std::map<TileIndex, StackTile> tiles = {};
  int num_puts = 0;
  int puts_until_failure = -1;  ///< Negative: never.
  bool fails_to_get = false;
};

class MemoryStore final : public TileStore {
 public:
  MemoryStore(TileLattice lattice, std::shared_ptr<StoredTiles> stored)
      : lattice_(std::move(lattice)), stored_(std::move(stored)) {}

  [[nodiscard]] const TileLattice& lattice() const override { return lattice_; }
  [[nodiscard]] Result<void> put(const StackTile& tile) override {
    HYPERMAP_TRY(validate(tile, lattice_));
    if (stored_->puts_until_failure == 0) return fail(ErrorCode::kIo, "the disk is full");
    --stored_->puts_until_failure;
    ++stored_->num_puts;
    stored_->tiles.insert_or_assign(tile.index, tile);
    return {};
  }
  [[nodiscard]] Result<std::optional<StackTile>> get(TileIndex index) const override {
    if (stored_->fails_to_get) return fail(ErrorCode::kIo, "the disk is gone");
    const auto found = stored_->tiles.find(index);
    if (found == stored_->tiles.end()) return std::optional<StackTile>();
    return std::optional(found->second);
  }
  [[nodiscard]] Result<std::vector<TileIndex>> list() const override {
    std::vector<TileIndex> all;
    all.reserve(stored_->tiles.size());
    for (const auto& [index, tile] : stored_->tiles) all.push_back(index);
    return all;
  }

 private:
  TileLattice lattice_;
  std::shared_ptr<StoredTiles> stored_;
};

}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Moving regions over a store in memory, and what they fuse.
#pragma once

#include "hypermap/projection/tiles/moving_region.hpp"
#include "memory_store.hpp"
#include "projection/stack/grid_builders.hpp"

#include <memory>
#include <string>
#include <utility>

namespace hypermap::test {

/// 5 x 3 tiles around the vehicle; one that is nearer than 0.8 m to the edge leaves them.
inline MovingRegion region_at(double x, double y, const std::shared_ptr<StoredTiles>& stored) {
  return MovingRegion::create({x, y},
                              std::make_unique<MemoryStore>(metre_tiles(), stored),
                              {.tile_cols = 5, .tile_rows = 3, .inner_margin_m = 0.8})
      .value();
}

inline SensorGrid reading(LogOddsGrid grid, std::string layer = "/ism/a") {
  return {.layer = std::move(layer), .grid = std::move(grid)};
}

}  // namespace hypermap::test

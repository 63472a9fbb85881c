// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Tiles for tests of their files.
#pragma once

#include "hypermap/projection/tiles/tile_store.hpp"
#include "projection/stack/grid_builders.hpp"

#include <cstdint>
#include <string>
#include <utility>

namespace hypermap::test {

/// 8 x 8 cells of 0.1 m.
inline TileLattice small_tiles() {
  return {.frame_id = "odom", .resolution_m = 0.1, .tile_cells = 8};
}

/// Two layers, with a datum.
inline StackTile sample_tile(TileIndex index,
                             std::uint64_t seed,
                             const TileLattice& lattice = small_tiles()) {
  const GridGeometry geometry = geometry_of(lattice, {.first = index}).value();
  StackTile tile{.index = index};
  for (const char* layer : {"/ism/laser", "/ism/camera/Tür"}) {
    tile.layers.emplace(layer, random_grid(geometry, seed++, 13'815));
  }
  tile.datum = GeographicDatum{.latitude_deg = 52.028421000000001,
                               .longitude_deg = 8.5323470000000001,
                               .altitude_m = 118.25,
                               .yaw_rad = 0.1};
  return tile;
}

}  // namespace hypermap::test

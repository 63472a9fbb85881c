// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/jobs/tile_set.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_tile_set(std::string_view bytes) {
  const auto set = parse_tile_set(bytes, "fuzz/tiles.json");
  if (!set) return;
  require(tiles_reached(*set, std::nullopt).size() == set->tiles.size(), "all tiles are reached");
  for (const MapTile& tile : set->tiles) {
    require(tile.file.find('/') == std::string::npos, "tiles lie beside their index");
  }
}

}  // namespace hypermap::fuzz

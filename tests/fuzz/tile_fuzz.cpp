// SPDX-License-Identifier: BSD-3-Clause
// Tiles of ours; what was read is written to what reads as equal.
#include "fuzz_target.hpp"
#include "hypermap/io/tiles/tile_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_tile(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return decode_tile(text, kFuzzSource); },
      [](const FiledTile& filed) { return encode_tile(filed.tile, filed.lattice); });
}

}  // namespace hypermap::fuzz

// SPDX-License-Identifier: BSD-3-Clause
// Tiles of [sogm]'s public implementation: a line with the file's name, then the cells.
#include "fuzz_target.hpp"
#include "hypermap/io/codec/byte_source.hpp"
#include "hypermap/io/tiles/sogm_tile.hpp"
#include "targets.hpp"

#include <algorithm>

namespace hypermap::fuzz {

void fuzz_sogm(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  const auto name = parse_sogm_tile_name(bytes.substr(0, end));
  if (!name) return;
  require(validate(name->geometry).has_value(), "a name that is read has a geometry");
  const auto source = view_bytes(bytes.substr(std::min(end + 1, bytes.size())));
  const auto grid = read_sogm_cells(*source, *name);
  if (!grid) return;
  require(grid->geometry() == name->geometry, "the cells are those of the name");
  require(source->size() >= name->geometry.num_cells(), "each cell was in the file");
}

}  // namespace hypermap::fuzz

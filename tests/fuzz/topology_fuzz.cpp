// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/topological_map_json.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_topology(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return parse_topological_map(text, kFuzzSource); },
      [](const TopologicalMap& map) { return write_topological_map(map); });
}

}  // namespace hypermap::fuzz

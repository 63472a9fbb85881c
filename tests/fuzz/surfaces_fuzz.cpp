// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/true_surfaces_json.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_surfaces(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return parse_true_surfaces(text, kFuzzSource); },
      write_true_surfaces);
}

}  // namespace hypermap::fuzz

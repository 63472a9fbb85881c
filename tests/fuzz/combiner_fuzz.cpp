// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/combiner/combiner_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_combiner(std::string_view bytes) {
  require_round_trip(
      bytes, [](std::string_view text) { return parse_combiner(text, "fuzz"); }, write_combiner);
}

}  // namespace hypermap::fuzz

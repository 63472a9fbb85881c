// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/vocabulary_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_vocabulary(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return parse_vocabulary(text, kFuzzSource); },
      write_vocabulary);
}

}  // namespace hypermap::fuzz

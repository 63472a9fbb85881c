// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/object_embeddings.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_embeddings(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return parse_object_embeddings(text, kFuzzSource); },
      write_object_embeddings);
}

}  // namespace hypermap::fuzz

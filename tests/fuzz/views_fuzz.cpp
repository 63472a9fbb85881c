// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/object_views.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_views(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return parse_object_views(text, kFuzzSource); },
      write_object_views);
}

}  // namespace hypermap::fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_objects(std::string_view bytes) {
  require_round_trip(
      bytes, [](std::string_view text) { return parse_objects(text, kFuzzSource); }, write_objects);
}

}  // namespace hypermap::fuzz

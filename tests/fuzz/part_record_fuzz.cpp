// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "part_record.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_part_record(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return parse_part_record(text, kFuzzSource); },
      write_part_record);
}

}  // namespace hypermap::fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/options/options_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_options(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) { return read_options(file_of(text, "options.yaml"), {}); },
      write_options);
}

}  // namespace hypermap::fuzz

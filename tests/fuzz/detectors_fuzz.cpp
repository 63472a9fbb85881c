// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/detectors_file.hpp"
#include "targets.hpp"

#include <utility>

namespace hypermap::fuzz {

void fuzz_detectors(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) -> Result<DetectorRegistry> {
        HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_detectors(text, kFuzzSource));
        return std::move(loaded.value);
      },
      write_detectors);
}

}  // namespace hypermap::fuzz

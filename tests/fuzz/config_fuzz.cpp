// SPDX-License-Identifier: BSD-3-Clause
// The configuration of an archive. Old versions are written as the newest.
#include "fuzz_target.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "targets.hpp"

#include <utility>

namespace hypermap::fuzz {

void fuzz_config(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) -> Result<HypermapConfig> {
        HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_hypermap_config(text, kFuzzSource));
        loaded.value.format_version = kArchiveFormatVersion;
        return std::move(loaded.value);
      },
      write_hypermap_config);
}

}  // namespace hypermap::fuzz

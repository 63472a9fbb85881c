// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/archive/provenance.hpp"
#include "targets.hpp"

#include <utility>
#include <vector>

namespace hypermap::fuzz {

void fuzz_provenance(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) -> Result<std::vector<Provenance>> {
        HYPERMAP_ASSIGN_OR_RETURN(auto loaded, parse_provenance(text, kFuzzSource));
        return std::move(loaded.value);
      },
      write_provenance);
}

}  // namespace hypermap::fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "targets.hpp"

#include <utility>

namespace hypermap::fuzz {

void fuzz_yaml(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) -> Result<ValueTree> {
        HYPERMAP_ASSIGN_OR_RETURN(YamlDocument document, parse_yaml(text, kFuzzSource));
        return std::move(document.value);
      },
      [](const ValueTree& tree) { return write_yaml(tree); });
}

}  // namespace hypermap::fuzz

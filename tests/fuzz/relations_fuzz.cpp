// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_target.hpp"
#include "hypermap/core/places/relation_options.hpp"
#include "hypermap/io/options/relation_rules_file.hpp"
#include "targets.hpp"

namespace hypermap::fuzz {

void fuzz_relations(std::string_view bytes) {
  const auto options = read_relation_options(file_of(bytes, "relations.yaml"));
  if (options) require(validate(*options).has_value(), "what was read are options");
}

}  // namespace hypermap::fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "shown_rules.hpp"

#include "hypermap/io/options/options_file.hpp"

#include <string_view>
#include <utility>

namespace hypermap::app {
namespace {

constexpr std::string_view kRulePrefixes[] = {"publication.", "absence."};

bool is_rule(std::string_view name) {
  for (const std::string_view prefix : kRulePrefixes) {
    if (name.starts_with(prefix)) return true;
  }
  return false;
}

}  // namespace

ShownRules rules_of(const MapArchive& archive) {
  MapOptions options;
  if (!archive.provenance.empty()) {
    for (const auto& [name, value] : archive.provenance.back().options.entries) {
      if (!is_rule(name)) continue;
      if (auto changed = with_option(options, name, value.text)) options = std::move(*changed);
    }
  }
  const ObjectPipelineOptions& objects = options.mapper.objects;
  return {.confirmation = objects.confirmation, .absence = objects.absence};
}

}  // namespace hypermap::app

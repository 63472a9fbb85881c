// SPDX-License-Identifier: BSD-3-Clause
#include "places/class_rules.hpp"

namespace hypermap {

std::optional<DeclaredPart> parse_part(std::string_view text) {
  constexpr std::string_view kOf = " of ";
  const std::size_t at = text.find(kOf);
  if (at == std::string_view::npos || at == 0 || at + kOf.size() == text.size()) {
    return std::nullopt;
  }
  return DeclaredPart{std::string(text.substr(0, at)), std::string(text.substr(at + kOf.size()))};
}

ClassRules::ClassRules(const RelationOptions& options, const ClassRegistry& classes) {
  for (const std::string& name : options.holders) {
    if (const auto id = classes.find(name)) holders_.insert(*id);
  }
  for (const std::string& text : options.parts) {
    const auto declared = parse_part(text);
    if (!declared) continue;
    const auto part = classes.find(declared->part);
    const auto whole = classes.find(declared->whole);
    if (part && whole) parts_.insert({*part, *whole});
  }
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/options/relation_rules_file.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/option_table.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "option_yaml.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

Error unknown_rule(const std::vector<BoundOption>& rules,
                   const std::string& name,
                   const YamlNode& node) {
  std::vector<std::string_view> known;
  known.reserve(rules.size());
  for (const BoundOption& rule : rules) known.emplace_back(rule.name);
  return node.error("unknown rule \"" + printable(name) + "\"" + did_you_mean(name, known),
                    ErrorCode::kNotFound);
}

}  // namespace

Result<RelationOptions> read_relation_options(const std::filesystem::path& path) {
  HYPERMAP_ASSIGN_OR_RETURN(const YamlDocument document, read_yaml(path));
  RelationOptions options;
  const std::vector<BoundOption> rules = bind_options(option_table(options), &options);
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, document.root().as_map());
  for (const auto& [name, node] : entries) {
    const auto rule = std::ranges::find(rules, name, &BoundOption::name);
    if (rule == rules.end()) return Unexpected(unknown_rule(rules, name, node));
    HYPERMAP_TRY(assign_yaml(*rule, node));
  }
  if (auto ok = validate(options); !ok) {
    Error error = std::move(ok).error();
    error.file = path.string();
    return Unexpected(std::move(error));
  }
  return options;
}

}  // namespace hypermap

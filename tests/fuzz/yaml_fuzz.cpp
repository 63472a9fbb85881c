// SPDX-License-Identifier: BSD-3-Clause
#include "flat_records.hpp"
#include "fuzz_target.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "targets.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace hypermap::fuzz {

namespace {

/// Also on the same lines.
bool is_same(const ValueTree& a, const ValueTree& b) {  // NOLINT(misc-no-recursion): flat
  const auto is_same_entry = [](const auto& x, const auto& y) {
    return x.first == y.first && is_same(x.second, y.second);
  };
  return a == b && a.line == b.line && std::ranges::equal(a.items, b.items, is_same) &&
         std::ranges::equal(a.entries, b.entries, is_same_entry);
}

/// What is read without YAML's own parser is what that makes of it, which a comment calls in.
void require_same_without_parser(std::string_view bytes) {
  const auto records = flat_records(bytes, {});
  if (!records) return;
  const auto parsed = parse_yaml(std::string(bytes) + "\n# parsed\n", kFuzzSource);
  require(is_same(require(parsed, "flat records are YAML").value, *records),
          "flat records are what YAML says");
}

}  // namespace

void fuzz_yaml(std::string_view bytes) {
  require_same_without_parser(bytes);
  require_round_trip(
      bytes,
      [](std::string_view text) -> Result<ValueTree> {
        HYPERMAP_ASSIGN_OR_RETURN(YamlDocument document, parse_yaml(text, kFuzzSource));
        return std::move(document.value);
      },
      [](const ValueTree& tree) { return write_yaml(tree); });
}

}  // namespace hypermap::fuzz

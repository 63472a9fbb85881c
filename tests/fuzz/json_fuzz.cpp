// SPDX-License-Identifier: BSD-3-Clause
// A document is written from its nodes, which walks all of them.
#include "fuzz_target.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "targets.hpp"

#include <cstddef>

namespace hypermap::fuzz {
namespace {

std::string text_of(const JsonNode& node) {  // NOLINT(misc-no-recursion): depth is bounded
  switch (node.kind()) {
    case JsonKind::kNull:
      return "null";
    case JsonKind::kBoolean:
      return *node.boolean() ? "true" : "false";
    case JsonKind::kNumber:
      return json_number(*node.number());
    case JsonKind::kString:
      return json_quoted(*node.string());
    default:
      break;
  }
  const bool is_object = node.is(JsonKind::kObject);
  std::string text(1, is_object ? '{' : '[');
  for (std::size_t i = 0; i < node.size(); ++i) {
    const JsonNode child = node.at(i);
    if (i > 0) text += ",";
    if (is_object) text += json_quoted(child.key()) + ":";
    text += text_of(child);
  }
  return text + (is_object ? "}" : "]");
}

}  // namespace

void fuzz_json(std::string_view bytes) {
  require_round_trip(
      bytes,
      [](std::string_view text) -> Result<std::string> {
        HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument document,
                                  JsonDocument::parse(text, kFuzzSource.file));
        return text_of(document.root());
      },
      [](const std::string& text) { return text; });
}

}  // namespace hypermap::fuzz

// SPDX-License-Identifier: BSD-3-Clause
#include "flat_records.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxFlatKeyBytes = 128;

bool is_ascii_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_ascii_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_null_text(std::string_view text) {
  return text == "~" || text == "null" || text == "Null" || text == "NULL";
}

bool is_flat_key(std::string_view key) {
  if (key.empty() || key.size() > kMaxFlatKeyBytes || is_null_text(key)) return false;
  if (!is_ascii_letter(key.front()) && key.front() != '_') return false;
  return std::all_of(key.begin(), key.end(), [](char c) {
    return is_ascii_letter(c) || is_ascii_digit(c) || c == '_';
  });
}

/// Whether the text is a bare scalar in any YAML.
bool is_flat_value(std::string_view value) {
  if (value == "~") return true;
  if (value.empty() || value.back() == ' ') return false;
  const bool is_negative = value.size() > 1 && value[0] == '-' && is_ascii_digit(value[1]);
  if (!is_ascii_letter(value[0]) && !is_ascii_digit(value[0]) && !is_negative) return false;
  char before = '\0';
  for (const char c : value) {
    const bool is_plain = is_ascii_letter(c) || is_ascii_digit(c) ||
                          std::string_view(" _.,()+-/").find(c) != std::string_view::npos;
    if (!is_plain || (c == ' ' && before == ' ')) return false;
    before = c;
  }
  return true;
}

/// A line of a record, taken apart.
struct FlatLine {
  bool begins_record = false;
  std::string_view key;
  std::string_view value;
};

std::optional<FlatLine> flat_line(std::string_view line) {
  FlatLine parts{.begins_record = line.starts_with("- "), .key = {}, .value = {}};
  if (!parts.begins_record && !line.starts_with("  ")) return std::nullopt;
  line.remove_prefix(2);
  const std::size_t colon = line.find(": ");
  if (colon == std::string_view::npos) return std::nullopt;
  parts.key = line.substr(0, colon);
  parts.value = line.substr(colon + 2);
  return is_flat_key(parts.key) && is_flat_value(parts.value) ? std::optional(parts) : std::nullopt;
}

}  // namespace

std::optional<ValueTree> flat_records(std::string_view bytes, const YamlLimits& limits) {
  if (!bytes.starts_with("- ") || limits.max_depth < 2) return std::nullopt;
  ValueTree records{.kind = ValueKind::kList, .line = 1};
  std::size_t num_nodes = 1;
  for (int number = 1; !bytes.empty(); ++number) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const auto line = flat_line(bytes.substr(0, end));
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    if (!line || line->value.size() > limits.max_flow_items) return std::nullopt;
    if (line->begins_record) {
      records.items.push_back({.kind = ValueKind::kMap, .line = number});
      ++num_nodes;
    }
    ValueTree& record = records.items.back();
    if (record.find(line->key) != nullptr || record.entries.size() >= limits.max_map_keys)
      return std::nullopt;
    ValueTree value{.line = number};
    if (!is_null_text(line->value)) {
      value.kind = ValueKind::kScalar;
      value.text = line->value;
    }
    record.entries.emplace_back(line->key, std::move(value));
    if (++num_nodes > limits.max_nodes) return std::nullopt;
  }
  return records;
}

}  // namespace hypermap

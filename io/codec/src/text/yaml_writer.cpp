// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/utf8.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace hypermap {
namespace {

constexpr std::string_view kHexDigits = "0123456789ABCDEF";

/// Whether the scalar stands within brackets or braces, where commas separate.
enum class Place { kBlock, kFlow };

/// Longest bare or quoted key that needs no question mark. Source: YAML 1.1, 9.1 (simple keys).
constexpr std::size_t kMaxSimpleKeyBytes = 1024;
/// Longest list in one line: readers keep all of a flow collection until it is closed.
constexpr std::size_t kMaxLineBytes = 65'536;

/// Text that starts like a number, which some reader may take for one.
bool starts_like_number(std::string_view text) {
  const std::size_t at = text.find_first_not_of("+-.");
  return at != std::string_view::npos && at < 3 && text[at] >= '0' && text[at] <= '9';
}

/// Text that every YAML reader takes as one bare scalar.
bool is_safe_bare(std::string_view text, Place place) {
  constexpr std::string_view kNeverFirst = "!&*-?|>@`%'\"#[]{},:=<~ ";
  constexpr std::string_view kNever = "\"'#[]{}:\\`|>&*!%@";
  if (text.empty() || kNeverFirst.find(text.front()) != std::string_view::npos) return false;
  if (text.back() == ' ' || text.starts_with("...") || starts_like_number(text)) return false;
  if (place == Place::kFlow && text.find_first_of(",?") != std::string_view::npos) return false;
  return std::all_of(text.begin(), text.end(), [&](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte >= 0x20 && byte < 0x7F && kNever.find(c) == std::string_view::npos;
  });
}

std::string hex_escaped(unsigned char code) {
  return {'\\', 'x', kHexDigits[code >> 4U], kHexDigits[code & 0xFU]};
}

/// One character within double quotes. Escaped are those that YAML does not allow as they are, and
/// those that other readers take as the end of a line (U+0085, U+2028, U+2029) or as a byte order.
std::string in_quotes_one(std::string_view character) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> kNamed{
      {{"\"", "\\\""},
       {"\\", "\\\\"},
       {"\n", "\\n"},
       {"\t", "\\t"},
       {"\r", "\\r"},
       {"\xE2\x80\xA8", "\\u2028"},
       {"\xE2\x80\xA9", "\\u2029"},
       {"\xEF\xBB\xBF", "\\uFEFF"}}};
  for (const auto& [active, escape] : kNamed) {
    if (character == active) return std::string(escape);
  }
  const auto first = static_cast<unsigned char>(character.front());
  if (first < 0x20 || first == 0x7F) return hex_escaped(first);
  const auto last = static_cast<unsigned char>(character.back());
  if (first == 0xC2 && last < 0xA0) return hex_escaped(last);  // U+0080 .. U+009F
  return std::string(character);
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  while (!text.empty()) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, 0), 1);
    out += in_quotes_one(text.substr(0, length));
    text.remove_prefix(length);
  }
  return out + "\"";
}

std::string scalar(const ValueTree& tree, Place place) {
  if (tree.kind == ValueKind::kNull) return "~";
  const bool bare = reads_as_no_text(tree.text) ? !tree.quoted : is_safe_bare(tree.text, place);
  return bare ? tree.text : in_quotes(tree.text);
}

bool is_scalar(const ValueTree& tree) {
  return tree.kind == ValueKind::kNull || tree.kind == ValueKind::kScalar;
}

bool is_empty(const ValueTree& tree) {
  return tree.items.empty() && tree.entries.empty();
}

/// The key and its colon; a key that is no simple one stands after a question mark, `between` it
/// and the colon.
std::string key_text(std::string_view key, std::string_view between) {
  const std::string text = yaml_scalar(key);
  if (text.size() <= kMaxSimpleKeyBytes) return text + ":";
  return "? " + text + std::string(between) + ":";
}

// NOLINTBEGIN(misc-no-recursion): the depth of a tree is bounded by whoever made it
std::string flow(const ValueTree& tree) {
  if (is_scalar(tree)) return scalar(tree, Place::kFlow);
  const bool is_list = tree.kind == ValueKind::kList;
  std::string out = is_list ? "[" : "{";
  std::string_view separator;
  for (const ValueTree& item : tree.items) {
    out += std::string(separator) + flow(item);
    separator = ", ";
  }
  for (const auto& [key, value] : tree.entries) {
    out += std::string(separator) + key_text(key, " ") + " " + flow(value);
    separator = ", ";
  }
  return out + (is_list ? "]" : "}");
}

/// Lists of scalars stay in one line, up to a length, as do empty collections.
bool fits_one_line(const ValueTree& tree) {
  if (is_scalar(tree) || is_empty(tree)) return true;
  if (tree.kind != ValueKind::kList) return false;
  std::size_t num_bytes = 0;
  return std::all_of(tree.items.begin(), tree.items.end(), [&](const ValueTree& item) {
    num_bytes += item.text.size() + 2;
    return is_scalar(item) && num_bytes <= kMaxLineBytes;
  });
}

/// What fits on the rest of a line.
std::string in_line(const ValueTree& tree) {
  return is_scalar(tree) ? scalar(tree, Place::kBlock) : flow(tree);
}

void append_block(std::string& out, const ValueTree& tree, std::size_t indent, bool first_inline);

void append_value(std::string& out, const ValueTree& value, std::size_t indent) {
  if (fits_one_line(value)) {
    out += " " + in_line(value) + "\n";
  } else {
    out += "\n";
    append_block(out, value, indent, false);
  }
}

/// `first_inline`: the first line continues one that has its indent already (after "- ").
void append_block(std::string& out, const ValueTree& tree, std::size_t indent, bool first_inline) {
  const std::string blanks(indent, ' ');
  bool is_first = first_inline;
  for (const ValueTree& item : tree.items) {
    out += (std::exchange(is_first, false) ? "" : blanks) + "-";
    if (fits_one_line(item)) {
      out += " " + in_line(item) + "\n";
    } else {
      out += " ";
      append_block(out, item, indent + 2, true);
    }
  }
  for (const auto& [key, value] : tree.entries) {
    out += (std::exchange(is_first, false) ? "" : blanks) + key_text(key, "\n" + blanks);
    append_value(out, value, indent + 2);
  }
}
// NOLINTEND(misc-no-recursion)

}  // namespace

std::string yaml_scalar(std::string_view text) {
  const bool bare = is_safe_bare(text, Place::kFlow) && !reads_as_no_text(text);
  return bare ? std::string(text) : in_quotes(text);
}

std::string write_yaml(const ValueTree& tree, YamlStyle style) {
  if (style == YamlStyle::kFlow || fits_one_line(tree)) return flow(tree) + "\n";
  std::string out;
  append_block(out, tree, 0, false);
  return out;
}

}  // namespace hypermap

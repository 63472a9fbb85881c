// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/value_tree.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace hypermap {
namespace {

ValueTree plain(std::string text) {
  return {.kind = ValueKind::kScalar, .text = std::move(text)};
}

/// Whether digits follow, after a sign and a point where there are any, and nothing stands among
/// them but what numbers, dates and times of any notation have, in a form that needs no quotes.
bool is_number_like(std::string_view text) {
  std::string_view rest = text;
  if (rest.front() == '+' || rest.front() == '-') rest.remove_prefix(1);
  if (!rest.empty() && rest.front() == '.') rest.remove_prefix(1);
  if (rest.empty() || rest.front() < '0' || rest.front() > '9') return false;
  const bool is_all = std::all_of(rest.begin(), rest.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           std::string_view("+-.:_ ").find(c) != std::string_view::npos;
  });
  return is_all && rest.back() != ':' && rest.back() != ' ' &&
         rest.find(": ") == std::string_view::npos;
}

}  // namespace

const ValueTree* ValueTree::find(std::string_view key) const {
  const auto found = std::find_if(
      entries.begin(), entries.end(), [&](const Entry& entry) { return entry.first == key; });
  return found == entries.end() ? nullptr : &found->second;
}

bool operator==(const ValueTree& a, const ValueTree& b) {  // NOLINT(misc-no-recursion): bounded
  return a.kind == b.kind && a.quoted == b.quoted && a.text == b.text && a.items == b.items &&
         a.entries == b.entries;
}

ValueTree make_list(std::vector<ValueTree> items) {
  return {.kind = ValueKind::kList, .items = std::move(items)};
}

ValueTree make_map(std::vector<ValueTree::Entry> entries) {
  return {.kind = ValueKind::kMap, .entries = std::move(entries)};
}

bool reads_as_no_text(std::string_view text) {
  constexpr std::array<std::string_view, 29> kWords = {
      "~",   "null", "Null", "NULL", "true", "True", "TRUE", "false", "False", "FALSE",
      "yes", "Yes",  "YES",  "no",   "No",   "NO",   "on",   "On",    "ON",    "off",
      "Off", "OFF",  "y",    "Y",    "n",    "N",    ".nan", ".NaN",  ".NAN"};
  if (text.empty() || std::find(kWords.begin(), kWords.end(), text) != kWords.end()) return true;
  const bool has_sign = text.front() == '+' || text.front() == '-';
  const std::string_view rest = has_sign ? text.substr(1) : text;
  if (rest == ".inf" || rest == ".Inf" || rest == ".INF") return true;
  return is_number_like(text);
}

ValueTree make_text(std::string text) {
  const bool quoted = reads_as_no_text(text);
  return {.kind = ValueKind::kScalar, .text = std::move(text), .quoted = quoted};
}

ValueTree make_number(double number) {
  if (std::isnan(number)) return plain(".nan");
  if (std::isinf(number)) return plain(number > 0 ? ".inf" : "-.inf");
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return plain(std::string(digits.data(), end.ptr));
}

ValueTree make_bool(bool value) {
  return plain(value ? "true" : "false");
}

}  // namespace hypermap

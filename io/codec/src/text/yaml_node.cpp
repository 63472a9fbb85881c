// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/utf8.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::max();

std::string kind_name(const ValueTree& value) {
  switch (value.kind) {
    case ValueKind::kNull:
      return "nothing";
    case ValueKind::kScalar:
      return "'" + printable(value.text) + "'";
    case ValueKind::kList:
      return "a list";
    case ValueKind::kMap:
      return "a map";
  }
  return "nothing";
}

std::string shown(double number) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  return std::string(digits.data(), end.ptr);
}

/// The text without a leading plus sign, which from_chars does not take.
std::string_view without_plus(std::string_view text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  return has_plus ? text.substr(1) : text;
}

/// A finite decimal number that is all of the text.
std::optional<double> parse_double(std::string_view text) {
  text = without_plus(text);
  double number = 0.0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_all = end.ec == std::errc() && end.ptr == text.data() + text.size();
  return is_all && std::isfinite(number) ? std::optional<double>(number) : std::nullopt;
}

std::optional<std::int64_t> parse_int(std::string_view text) {
  text = without_plus(text);
  const std::string_view digits = text.starts_with('-') ? text.substr(1) : text;
  if (digits.size() > 1 && digits[0] == '0') return std::nullopt;  // octal elsewhere
  std::int64_t number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_all = end.ec == std::errc() && end.ptr == text.data() + text.size();
  return is_all ? std::optional<std::int64_t>(number) : std::nullopt;
}

}  // namespace

std::optional<YamlNode> YamlNode::find(std::string_view key) const {
  const ValueTree* found = value_->find(key);
  if (found == nullptr) return std::nullopt;
  const std::string name(key);
  return YamlNode(*found, path_.empty() ? name : path_ + "." + name, *source_);
}

Result<YamlNode> YamlNode::at(std::string_view key) const {
  if (!is_map()) return tl::make_unexpected(error("is " + kind_name(*value_) + ", expected a map"));
  if (auto found = find(key)) return *std::move(found);
  Error missing = error("the key is missing");
  missing.field = path_.empty() ? std::string(key) : path_ + "." + std::string(key);
  return tl::make_unexpected(std::move(missing));
}

Result<std::vector<YamlNode>> YamlNode::as_list() const {
  if (!is_list()) {
    return tl::make_unexpected(error("is " + kind_name(*value_) + ", expected a list"));
  }
  std::vector<YamlNode> nodes;
  nodes.reserve(value_->items.size());
  for (std::size_t i = 0; i < value_->items.size(); ++i) {
    nodes.emplace_back(value_->items[i], path_ + "[" + std::to_string(i) + "]", *source_);
  }
  return nodes;
}

Result<std::vector<std::pair<std::string, YamlNode>>> YamlNode::as_map() const {
  if (!is_map()) return tl::make_unexpected(error("is " + kind_name(*value_) + ", expected a map"));
  std::vector<std::pair<std::string, YamlNode>> nodes;
  nodes.reserve(value_->entries.size());
  for (const auto& [key, value] : value_->entries) {
    nodes.emplace_back(key, YamlNode(value, path_.empty() ? key : path_ + "." + key, *source_));
  }
  return nodes;
}

Result<std::string> YamlNode::as_string() const {
  if (!is_scalar()) {
    return tl::make_unexpected(error("is " + kind_name(*value_) + ", expected text"));
  }
  return value_->text;
}

Result<double> YamlNode::as_double(double min, double max) const {
  const auto number = is_scalar() ? parse_double(value_->text) : std::nullopt;
  if (number && *number >= min && *number <= max) return *number;
  std::string expected = ", expected a finite number";
  if (min > -kNoBound || max < kNoBound) {
    expected += " from " + shown(min) + " to " + shown(max);
  }
  return tl::make_unexpected(error("is " + kind_name(*value_) + expected));
}

Result<double> YamlNode::as_double() const {
  return as_double(-kNoBound, kNoBound);
}

Result<std::int64_t> YamlNode::as_int(std::int64_t min, std::int64_t max) const {
  const auto number = is_scalar() ? parse_int(value_->text) : std::nullopt;
  if (number && *number >= min && *number <= max) return *number;
  return tl::make_unexpected(error("is " + kind_name(*value_) + ", expected an integer from " +
                                   std::to_string(min) + " to " + std::to_string(max)));
}

Result<bool> YamlNode::as_bool() const {
  constexpr std::array<std::string_view, 9> kTrue = {
      "true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON"};
  constexpr std::array<std::string_view, 9> kFalse = {
      "false", "False", "FALSE", "no", "No", "NO", "off", "Off", "OFF"};
  if (is_scalar() && !value_->quoted) {
    if (std::find(kTrue.begin(), kTrue.end(), value_->text) != kTrue.end()) return true;
    if (std::find(kFalse.begin(), kFalse.end(), value_->text) != kFalse.end()) return false;
  }
  return tl::make_unexpected(error("is " + kind_name(*value_) + ", expected true or false"));
}

Result<std::vector<double>> YamlNode::as_doubles(std::size_t count) const {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<YamlNode> nodes, as_list());
  if (nodes.size() != count) {
    return tl::make_unexpected(error("has " + std::to_string(nodes.size()) + " values, expected " +
                                     std::to_string(count) + " numbers"));
  }
  std::vector<double> numbers;
  for (const YamlNode& node : nodes) {
    HYPERMAP_ASSIGN_OR_RETURN(const double number, node.as_double());
    numbers.push_back(number);
  }
  return numbers;
}

Error YamlNode::error(std::string what, ErrorCode code) const {
  return {.code = code,
          .what = std::move(what),
          .file = source_->file,
          .entry = source_->entry,
          .field = path_,
          .line = value_->line};
}

Result<void> YamlNode::refuse_other_keys(std::span<const std::string_view> known,
                                         ErrorCode code) const {
  HYPERMAP_ASSIGN_OR_RETURN(const auto children, as_map());
  for (const auto& [key, child] : children) {
    if (std::ranges::find(known, key) != known.end()) continue;
    return Unexpected(
        child.error("unknown key \"" + printable(key) + "\"" + did_you_mean(key, known), code));
  }
  return {};
}

std::vector<Finding> YamlNode::unknown_keys(std::span<const std::string_view> known) const {
  std::vector<Finding> findings;
  for (const auto& [key, value] : value_->entries) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    Error error = YamlNode(value, path_.empty() ? key : path_ + "." + key, *source_)
                      .error("unknown key, kept" + did_you_mean(key, known));
    findings.push_back({Severity::kWarning, std::move(error)});
  }
  return findings;
}

}  // namespace hypermap

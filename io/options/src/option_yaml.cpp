// SPDX-License-Identifier: BSD-3-Clause
#include "option_yaml.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/io/codec/bounded_json.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kNone = "none";

template <class Items, class Text>
std::string list_text(const Items& items, const Text& text) {
  std::string out = "[";
  for (const auto& item : items) out += (out.size() > 1 ? ", " : "") + text(item);
  return out + "]";
}

std::string choice_text(const OptionRow& row, double position) {
  const bool has_name = position >= 0.0 && position < static_cast<double>(row.choices.size());
  return has_name ? std::string(row.choices[static_cast<std::size_t>(position)])
                  : json_number(position);
}

bool says_none(const YamlNode& node) {
  const auto text = node.as_string();
  return node.is_null() || (text && *text == kNone);
}

Result<double> whole_number(const YamlNode& node) {
  using Limits = std::numeric_limits<std::int64_t>;
  HYPERMAP_ASSIGN_OR_RETURN(const std::int64_t number, node.as_int(Limits::min(), Limits::max()));
  return static_cast<double>(number);
}

Result<double> chosen(const OptionRow& row, const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string text, node.as_string());
  const auto found = std::find(row.choices.begin(), row.choices.end(), text);
  if (found != row.choices.end()) return static_cast<double>(found - row.choices.begin());
  std::vector<std::string_view> names(row.choices.begin(), row.choices.end());
  if (row.may_be_none) names.push_back(kNone);
  return Unexpected(node.error(not_one_of(text, names)));
}

Result<double> scalar(const OptionRow& row, const YamlNode& node) {
  switch (row.kind) {
    case OptionKind::kFlag:
      return node.as_bool();
    case OptionKind::kCount:
      return whole_number(node);
    case OptionKind::kChoice:
      return chosen(row, node);
    default:
      return node.as_double();
  }
}

Result<void> assign_checked(const BoundOption& option,
                            const OptionValue& value,
                            const YamlNode& node) {
  if (const auto checked = check_value(*option.row, value); !checked) {
    return Unexpected(node.error(checked.error().what));
  }
  option.assign(value);
  return {};
}

Result<void> assign_names(const BoundOption& option, const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto items, node.as_list());
  std::vector<std::string> names;
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string text, item.as_string());
    names.push_back(std::move(text));
  }
  return assign_checked(option, OptionValue(OptionValue::Names(names)), node);
}

Result<void> assign_numbers(const BoundOption& option, const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<double> numbers,
                            node.as_doubles(option.value().numbers().size()));
  return assign_checked(option, OptionValue(OptionValue::Numbers(numbers)), node);
}

Result<void> assign_named_numbers(const BoundOption& option, const YamlNode& node) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto entries, node.as_map());
  std::vector<NamedNumber> numbers;
  for (const auto& [name, value] : entries) {
    HYPERMAP_ASSIGN_OR_RETURN(const double number, value.as_double());
    numbers.push_back({.name = name, .number = number});
  }
  return assign_checked(option, OptionValue(OptionValue::NamedNumbers(numbers)), node);
}

std::string named_numbers_text(OptionValue::NamedNumbers numbers) {
  std::string out = "{";
  for (const auto& [name, number] : numbers) {
    out += (out.size() > 1 ? ", " : "") + yaml_scalar(name) + ": " + json_number(number);
  }
  return out + "}";
}

}  // namespace

std::string yaml_text(const BoundOption& option) {
  const OptionValue value = option.value();
  if (value.is_none()) return std::string(kNone);
  switch (option.row->kind) {
    case OptionKind::kFlag:
      return value.scalar() != 0.0 ? "true" : "false";
    case OptionKind::kCount:
      return std::to_string(static_cast<std::int64_t>(value.scalar()));
    case OptionKind::kChoice:
      return choice_text(*option.row, value.scalar());
    case OptionKind::kNumbers:
      return list_text(value.numbers(), json_number);
    case OptionKind::kNames:
      return list_text(value.names(), [](const std::string& name) { return yaml_scalar(name); });
    case OptionKind::kNamedNumbers:
      return named_numbers_text(value.named_numbers());
    default:
      return json_number(value.scalar());
  }
}

Result<void> assign_yaml(const BoundOption& option, const YamlNode& node) {
  const OptionRow& row = *option.row;
  if (row.may_be_none && says_none(node)) return assign_checked(option, kNoValue, node);
  if (row.kind == OptionKind::kNames) return assign_names(option, node);
  if (row.kind == OptionKind::kNumbers) return assign_numbers(option, node);
  if (row.kind == OptionKind::kNamedNumbers) return assign_named_numbers(option, node);
  HYPERMAP_ASSIGN_OR_RETURN(const double value, scalar(row, node));
  return assign_checked(option, value, node);
}

}  // namespace hypermap

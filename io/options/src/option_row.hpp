// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One option: what it is called, what it means, and how its field is read and written.
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/codec/bounded_json.hpp"
#include "hypermap/io/codec/bounded_yaml.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace hypermap {

struct OptionRow {
  std::string name;
  std::string unit;
  std::string range;
  std::string source;
  std::string effect;
  std::function<std::string(const MapOptions&)> text;
  std::function<Result<void>(MapOptions&, const YamlNode&)> assign;
};

struct OptionRange {
  double min = 0.0;
  double max = 1.0;
};

/// One field's value as YAML has it, and back.
inline std::string option_text(double value) {
  return json_number(value);
}
inline std::string option_text(int value) {
  return std::to_string(value);
}
inline std::string option_text(std::uint32_t value) {
  return std::to_string(value);
}
inline std::string option_text(bool value) {
  return value ? "true" : "false";
}
inline std::string option_text(LogOdds value) {
  return json_number(value.value());
}
inline std::string option_text(Probability value) {
  return json_number(value.value());
}
template <class Value>
std::string option_text(const std::optional<Value>& value) {
  return value ? option_text(*value) : "none";
}
template <std::size_t N>
std::string option_text(const std::array<double, N>& values) {
  std::string out = "[";
  for (const double value : values) out += (out.size() > 1 ? ", " : "") + json_number(value);
  return out + "]";
}
inline std::string option_text(const std::vector<std::string>& values) {
  std::string out = "[";
  for (const std::string& value : values) out += (out.size() > 1 ? ", " : "") + yaml_scalar(value);
  return out + "]";
}

inline Result<double> option_number(const YamlNode& node, OptionRange range) {
  return node.as_double(range.min, range.max);
}

inline Result<void> assign_option(double& field, const YamlNode& node, OptionRange range) {
  HYPERMAP_ASSIGN_OR_RETURN(field, option_number(node, range));
  return {};
}
template <class Integer>
requires std::is_same_v<Integer, int> || std::is_same_v<Integer, std::uint32_t> Result<void>
assign_option(Integer& field, const YamlNode& node, OptionRange range) {
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto value,
      node.as_int(static_cast<std::int64_t>(range.min), static_cast<std::int64_t>(range.max)));
  field = static_cast<Integer>(value);
  return {};
}
inline Result<void> assign_option(bool& field, const YamlNode& node, OptionRange) {
  HYPERMAP_ASSIGN_OR_RETURN(field, node.as_bool());
  return {};
}
inline Result<void> assign_option(LogOdds& field, const YamlNode& node, OptionRange range) {
  HYPERMAP_ASSIGN_OR_RETURN(const double value, option_number(node, range));
  field = LogOdds(value);
  return {};
}
inline Result<void> assign_option(Probability& field, const YamlNode& node, OptionRange range) {
  HYPERMAP_ASSIGN_OR_RETURN(const double value, option_number(node, range));
  field = Probability(value);
  return {};
}
template <class Value>
Result<void> assign_option(std::optional<Value>& field, const YamlNode& node, OptionRange range) {
  const auto text = node.as_string();
  if (node.is_null() || (text && *text == "none")) {
    field.reset();
    return {};
  }
  Value value;
  HYPERMAP_TRY(assign_option(value, node, range));
  field = value;
  return {};
}
template <std::size_t N>
Result<void> assign_option(std::array<double, N>& field, const YamlNode& node, OptionRange range) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto items, node.as_list());
  if (items.size() != N) {
    return Unexpected(node.error("must have " + std::to_string(N) + " numbers, has " +
                                 std::to_string(items.size())));
  }
  for (std::size_t i = 0; i < N; ++i) {
    HYPERMAP_ASSIGN_OR_RETURN(field.at(i), option_number(items[i], range));
  }
  return {};
}
inline Result<void> assign_option(std::vector<std::string>& field,
                                  const YamlNode& node,
                                  OptionRange) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto items, node.as_list());
  field.clear();
  for (const YamlNode& item : items) {
    HYPERMAP_ASSIGN_OR_RETURN(std::string text, item.as_string());
    field.push_back(std::move(text));
  }
  return {};
}

/// What stands beside the value.
struct OptionNotes {
  const char* unit = "";
  const char* source = "ours";
  const char* effect = "";
};

/// A row for the field that `get` gives of options, const or not.
template <class Get>
OptionRow option_row(const char* name, OptionRange range, OptionNotes notes, Get get) {
  using Field = std::remove_cvref_t<decltype(get(std::declval<MapOptions&>()))>;
  std::string range_text = json_number(range.min) + " .. " + json_number(range.max);
  if constexpr (std::is_same_v<Field, bool>) range_text = "true, false";
  if constexpr (std::is_same_v<Field, std::vector<std::string>>) range_text = "names";
  return {name,
          notes.unit,
          std::move(range_text),
          notes.source,
          notes.effect,
          [get](const MapOptions& options) { return option_text(get(options)); },
          [get, range](MapOptions& options, const YamlNode& node) {
            return assign_option(get(options), node, range);
          }};
}

/// A row for an enumeration whose values are named in the order of its enumerators from 0 on.
template <class Get>
OptionRow choice_row(const char* name,
                     const std::vector<std::string>& names,
                     OptionNotes notes,
                     Get get) {
  std::string range;
  for (const std::string& choice : names) range += (range.empty() ? "" : ", ") + choice;
  return {name,
          notes.unit,
          range,
          notes.source,
          notes.effect,
          [get, names](const MapOptions& options) {
            return names.at(static_cast<std::size_t>(get(options)));
          },
          [get, names, range](MapOptions& options, const YamlNode& node) -> Result<void> {
            HYPERMAP_ASSIGN_OR_RETURN(const std::string text, node.as_string());
            for (std::size_t i = 0; i < names.size(); ++i) {
              if (names[i] != text) continue;
              auto& field = get(options);
              field = static_cast<std::remove_cvref_t<decltype(field)>>(i);
              return {};
            }
            return Unexpected(node.error("must be one of " + range + ", is " + printable(text)));
          }};
}

// NOLINTBEGIN(bugprone-macro-parentheses): the name of a member cannot stand in parentheses
/// The field of the mapper's options that `path` names, for const and other options alike.
#define HYPERMAP_OPTION_FIELD(path) \
  [](auto& options) -> auto& {      \
    return options.mapper.path;     \
  }
/// The same for options of the 2D layers.
#define HYPERMAP_LAYER_OPTION_FIELD(path) \
  [](auto& options) -> auto& {            \
    return options.layers.path;           \
  }
// NOLINTEND(bugprone-macro-parentheses)

/// The table, in parts.
[[nodiscard]] std::vector<OptionRow> map_option_rows();
[[nodiscard]] std::vector<OptionRow> segmentation_option_rows();
[[nodiscard]] std::vector<OptionRow> association_option_rows();
[[nodiscard]] std::vector<OptionRow> presence_option_rows();
[[nodiscard]] std::vector<OptionRow> layer_option_rows();

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "option_flags.hpp"

#include "choices.hpp"
#include "number_lists.hpp"

#include <CLI/Validators.hpp>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <vector>

namespace hypermap::app {
namespace {

OptionDescription description_of(const std::string& name) {
  const auto options = describe_options({});
  const auto found = std::ranges::find(options, name, &OptionDescription::name);
  assert(found != options.end());
  return *found;
}

std::string range_with_unit(const std::string& range, std::string_view unit) {
  return range + (unit.empty() ? "" : " " + std::string(unit));
}

/// Counts are read as CLI11 will read them; it takes no part of a number.
std::optional<double> number_of(const OptionRow& row, const std::string& text) {
  if (row.kind == OptionKind::kNumber) return finite_number(text);
  std::int64_t count = 0;
  if (!CLI::detail::lexical_cast(text, count)) return std::nullopt;
  return static_cast<double>(count);
}

}  // namespace

CLI::Validator value_of_option(const std::string& name) {
  const auto check = [name](const std::string& text) {
    const auto checked = check_option(name, text);
    return checked ? std::string() : checked.error().what;
  };
  const OptionDescription option = description_of(name);
  return {check, range_with_unit(option.range, option.unit), name};
}

CLI::Validator choice_of_option(const std::string& name) {
  const OptionDescription option = description_of(name);
  assert(!option.choices.empty());
  return one_of(option.choices);
}

std::string default_of_option(const std::string& name) {
  return description_of(name).value;
}

CLI::Validator value_of_field(const OptionTable& table, std::string_view name) {
  const auto found = std::ranges::find(table.rows, name, &OptionRow::name);
  assert(found != table.rows.end());
  const OptionRow& row = *found;
  const auto check = [&row](const std::string& text) -> std::string {
    const auto number = number_of(row, text);
    const std::string wanted = row.kind == OptionKind::kCount ? "a whole number" : "a number";
    if (!number) return "must be " + wanted + ", is '" + printable(text) + "'";
    const auto checked = check_value(row, *number);
    return checked ? std::string() : checked.error().what;
  };
  return {check, range_with_unit(to_string(row.range), row.unit), std::string(name)};
}

Result<MapOptions> with_flags(MapOptions options, std::initializer_list<OptionFlag> flags) {
  for (const OptionFlag& flag : flags) {
    if (!flag.text) continue;
    HYPERMAP_ASSIGN_OR_RETURN(options, with_option(options, flag.name, *flag.text));
  }
  return options;
}

}  // namespace hypermap::app

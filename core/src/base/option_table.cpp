// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_table.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// Without an exponent: 100000, 0.000001.
std::string plain_text(double value) {
  std::array<char, 400> buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return {buffer.data(), error == std::errc{} ? end : buffer.data()};
}

std::string within(std::string_view section, const std::string& field) {
  return section.empty() ? field : std::string(section) + "." + field;
}

Unexpected refused(const std::string& rule, const std::string& value) {
  return fail(ErrorCode::kInvalidArgument, rule + ", is " + value);
}

bool is_plain_interval(const OptionRange& range) {
  return !range.excludes_min && !range.excludes_max && std::isfinite(range.min) &&
         std::isfinite(range.max);
}

std::string interval_rule(const OptionRange& range) {
  const bool is_within = is_plain_interval(range) && !range.includes_zero;
  return (is_within ? "must be in " : "must be ") + to_string(range);
}

/// "above 0", "at least 0"; empty where there is no lower end.
std::string lower_end(const OptionRange& range) {
  if (range.min == -kUnbounded) return "";
  return (range.excludes_min ? "above " : "at least ") + plain_text(range.min);
}

/// "below 1", "at most 1"; "finite" where only infinity lies beyond.
std::string upper_end(const OptionRange& range) {
  if (range.max == kUnbounded) return range.excludes_max ? "finite" : "";
  return (range.excludes_max ? "below " : "at most ") + plain_text(range.max);
}

Result<void> check_choice(const OptionRow& row, double position) {
  if (position >= 0.0 && position < static_cast<double>(row.choices.size())) return {};
  return refused("must be one of " + range_text(row), "no. " + number_text(position));
}

Result<void> check_row(const OptionRow& row, const void* options) {
  const bool is_section = row.kind == OptionKind::kSection;
  const void* part = is_section ? row.part(options) : nullptr;
  Result<void> checked =
      is_section ? check_table(row.table(part), part) : check_value(row, row.get(options));
  if (checked) return checked;
  Error error = std::move(checked).error();
  error.field = is_section ? within(row.name, error.field) : std::string(row.name);
  return Unexpected(std::move(error));
}

Result<void> check_rows(const OptionTable& table, const void* options) {
  for (const OptionRow& row : table.rows) HYPERMAP_TRY(check_row(row, options));
  return table.rule == nullptr ? Result<void>{} : table.rule(options);
}

void append(const OptionTable& table,
            const std::string& prefix,
            void* options,
            std::vector<BoundOption>& out) {
  for (const OptionRow& row : table.rows) {
    if (row.kind == OptionKind::kSection) {
      const std::string inner = row.name.empty() ? prefix : prefix + std::string(row.name) + ".";
      void* part = row.part_to_set(options);
      append(row.table(part), inner, part, out);
    } else if (row.is_listed) {
      out.push_back({prefix + std::string(row.name), &row, options});
    }
  }
}

Result<void> check_named_numbers(const OptionRow& row, OptionValue::NamedNumbers numbers) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto& [name, number] = numbers[i];
    if (name.empty()) return fail(ErrorCode::kInvalidArgument, "must name each number");
    if (std::ranges::find(numbers.first(i), name, &NamedNumber::name) != numbers.first(i).end()) {
      return fail(ErrorCode::kInvalidArgument,
                  "must name each once, \"" + printable(name) + "\" is there twice");
    }
    if (row.range.contains(number)) continue;
    return fail(ErrorCode::kInvalidArgument,
                "each " + interval_rule(row.range) + ", that of \"" + printable(name) + "\" is " +
                    number_text(number));
  }
  return {};
}

}  // namespace

std::string to_string(const OptionRange& range) {
  const std::string zero = range.includes_zero ? "0 or " : "";
  if (is_plain_interval(range))
    return zero + plain_text(range.min) + " .. " + plain_text(range.max);
  const std::string lower = lower_end(range);
  const std::string upper = upper_end(range);
  if (lower.empty() && upper.empty()) return "a number";
  return zero + lower + (lower.empty() || upper.empty() ? "" : " and ") + upper;
}

std::string range_text(const OptionRow& row) {
  switch (row.kind) {
    case OptionKind::kFlag:
      return "true, false";
    case OptionKind::kNames:
      return "names";
    case OptionKind::kNamedNumbers:
      return "numbers by name, each " + to_string(row.range);
    case OptionKind::kChoice: {
      std::string text;
      for (const std::string_view name : row.choices) {
        text += (text.empty() ? "" : ", ") + std::string(name);
      }
      return text;
    }
    default:
      return (row.may_be_none ? "none or " : "") + to_string(row.range);
  }
}

Result<void> check_value(const OptionRow& row, const OptionValue& value) {
  if (value.is_none()) {
    if (row.may_be_none) return {};
    return refused(interval_rule(row.range), "none");
  }
  switch (row.kind) {
    case OptionKind::kCount:
    case OptionKind::kNumber:
      if (row.range.contains(value.scalar())) return {};
      return refused(interval_rule(row.range), number_text(value.scalar()));
    case OptionKind::kChoice:
      return check_choice(row, value.scalar());
    case OptionKind::kNamedNumbers:
      return check_named_numbers(row, value.named_numbers());
    case OptionKind::kNumbers:
      for (const double number : value.numbers()) {
        if (!row.range.contains(number)) {
          return fail(ErrorCode::kInvalidArgument,
                      "each " + interval_rule(row.range) + ", one is " + number_text(number));
        }
      }
      return {};
    default:
      return {};
  }
}

Result<void> check_table(const OptionTable& table, const void* options, std::string_view section) {
  Result<void> checked = check_rows(table, options);
  if (checked) return checked;
  Error error = std::move(checked).error();
  error.field = within(section, error.field);
  return Unexpected(std::move(error));
}

Result<void> check_above(std::string_view lower_name,
                         double lower,
                         std::string_view upper_name,
                         double upper) {
  if (upper > lower) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be above " + std::string(lower_name) + " (" + number_text(lower) + "), is " +
                  number_text(upper),
              std::string(upper_name));
}

void set_preset(const OptionTable& table, PresetName preset, void* options) {
  if (preset == PresetName::kDefault) return;
  for (const OptionRow& row : table.rows) {
    if (row.kind == OptionKind::kSection) {
      void* part = row.part_to_set(options);
      set_preset(row.table(part), preset, part);
    } else if (const auto& value = preset == PresetName::kSmap ? row.smap : row.hypermap) {
      row.set(options, *value);
    }
  }
}

std::vector<BoundOption> bind_options(const OptionTable& table, void* options) {
  std::vector<BoundOption> out;
  append(table, "", options, out);
  return out;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the owner of an options struct writes its table. For .cpp files.
///
///     constexpr OptionRow kDeadlineRows[] = {
///         option::choice<&DeadlineOptions::rule>("rule", kRuleNames, {.effect = "..."}),
///         option::number<&DeadlineOptions::frame_s>(
///             "frame_s", option::above(0, 3600), {.unit = "s", .effect = "..."})};
///     const OptionTable& option_table(const DeadlineOptions&) {
///       static constexpr OptionTable kTable{kDeadlineRows};
///       return kTable;
///     }
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/base/option_table.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace hypermap {

/// What stands beside name and range.
struct OptionNotes {
  std::string_view unit = "";
  std::string_view source = "ours";
  std::string_view effect = "";
  std::optional<OptionValue> smap = {};
  std::optional<OptionValue> hypermap = {};
  bool is_listed = true;
};

namespace option {

/// min <= value; for whole numbers, and where infinity has a meaning.
[[nodiscard]] constexpr OptionRange at_least(double min) {
  return {.min = min, .max = kUnbounded};
}
/// min < value <= max.
[[nodiscard]] constexpr OptionRange above(double min, double max) {
  return {.min = min, .max = max, .excludes_min = true};
}
/// min <= value < max.
[[nodiscard]] constexpr OptionRange below(double min, double max) {
  return {.min = min, .max = max, .excludes_max = true};
}
/// min < value < max.
[[nodiscard]] constexpr OptionRange inside(double min, double max) {
  return {.min = min, .max = max, .excludes_min = true, .excludes_max = true};
}
/// 0, or min <= value <= max.
[[nodiscard]] constexpr OptionRange zero_or(double min, double max) {
  return {.min = min, .max = max, .includes_zero = true};
}

namespace detail {

template <class Field>
struct IsOptional : std::false_type {
  using Held = Field;
};
template <class Value>
struct IsOptional<std::optional<Value>> : std::true_type {
  using Held = Value;
};

template <class Field>
OptionValue value_of(const Field& field) {
  return OptionValue(field);
}
template <class Value>
OptionValue value_of(const std::optional<Value>& field) {
  return field ? value_of(*field) : kNoValue;
}
template <std::size_t N>
OptionValue value_of(const std::array<double, N>& field) {
  return OptionValue(OptionValue::Numbers(field));
}
inline OptionValue value_of(const std::vector<std::string>& field) {
  return OptionValue(OptionValue::Names(field));
}
inline OptionValue value_of(const std::vector<NamedNumber>& field) {
  return OptionValue(OptionValue::NamedNumbers(field));
}

template <class Field>
void assign(Field& field, const OptionValue& value) {
  field = static_cast<Field>(value.scalar());
}
template <class Value>
void assign(std::optional<Value>& field, const OptionValue& value) {
  field.reset();
  if (!value.is_none()) assign(field.emplace(), value);
}
template <std::size_t N>
void assign(std::array<double, N>& field, const OptionValue& value) {
  assert(value.numbers().size() == N);
  std::copy_n(value.numbers().begin(), N, field.begin());
}
inline void assign(std::vector<std::string>& field, const OptionValue& value) {
  field.assign(value.names().begin(), value.names().end());
}
inline void assign(std::vector<NamedNumber>& field, const OptionValue& value) {
  field.assign(value.named_numbers().begin(), value.named_numbers().end());
}

/// The struct and the field of a pointer to member.
template <auto Member>
struct Access;
template <class Struct, class Type, Type Struct::*Member>
struct Access<Member> {
  using Field = Type;
  static OptionValue get(const void* options) {
    return value_of(static_cast<const Struct*>(options)->*Member);
  }
  static void set(void* options, const OptionValue& value) {
    assign(static_cast<Struct*>(options)->*Member, value);
  }
  static const void* part(const void* options) {
    return &(static_cast<const Struct*>(options)->*Member);
  }
  static void* part_to_set(void* options) { return &(static_cast<Struct*>(options)->*Member); }
  static const OptionTable& table(const void* part) {
    return option_table(*static_cast<const Field*>(part));
  }
};

template <auto Member>
constexpr OptionRow row(std::string_view name, OptionKind kind, const OptionNotes& notes) {
  using Field = typename Access<Member>::Field;
  return {.name = name,
          .kind = kind,
          .may_be_none = IsOptional<Field>::value,
          .is_listed = notes.is_listed,
          .unit = notes.unit,
          .source = notes.source,
          .effect = notes.effect,
          .smap = notes.smap,
          .hypermap = notes.hypermap,
          .get = Access<Member>::get,
          .set = Access<Member>::set};
}

template <class Rule>
struct RuleAccess;
template <class Options>
struct RuleAccess<Result<void> (*)(const Options&)> {
  template <Result<void> (*Rule)(const Options&)>
  static Result<void> check(const void* options) {
    return Rule(*static_cast<const Options*>(options));
  }
};

}  // namespace detail

/// A real number, a probability or log-odds, or several of them in an array.
template <auto Member>
constexpr OptionRow number(std::string_view name, OptionRange range, const OptionNotes& notes) {
  using Field = typename detail::Access<Member>::Field;
  constexpr bool kIsScalar = !requires(Field field) {
    field.size();
  };
  OptionRow row =
      detail::row<Member>(name, kIsScalar ? OptionKind::kNumber : OptionKind::kNumbers, notes);
  row.range = range;
  return row;
}

/// A whole number, perhaps none.
template <auto Member>
constexpr OptionRow count(std::string_view name, OptionRange range, const OptionNotes& notes) {
  using Field = typename detail::Access<Member>::Field;
  static_assert(std::is_integral_v<typename detail::IsOptional<Field>::Held>);
  OptionRow row = detail::row<Member>(name, OptionKind::kCount, notes);
  row.range = range;
  return row;
}

template <auto Member>
constexpr OptionRow flag(std::string_view name, const OptionNotes& notes) {
  static_assert(std::is_same_v<typename detail::Access<Member>::Field, bool>);
  return detail::row<Member>(name, OptionKind::kFlag, notes);
}

/// An enumeration whose enumerators, from 0 on, have these names.
template <auto Member>
constexpr OptionRow choice(std::string_view name,
                           std::span<const std::string_view> choices,
                           const OptionNotes& notes) {
  static_assert(std::is_enum_v<typename detail::Access<Member>::Field>);
  OptionRow row = detail::row<Member>(name, OptionKind::kChoice, notes);
  row.choices = choices;
  return row;
}

/// A list of names.
template <auto Member>
constexpr OptionRow names(std::string_view name, const OptionNotes& notes) {
  return detail::row<Member>(name, OptionKind::kNames, notes);
}

/// A number for each of some names.
template <auto Member>
constexpr OptionRow named_numbers(std::string_view name,
                                  OptionRange range,
                                  const OptionNotes& notes) {
  OptionRow row = detail::row<Member>(name, OptionKind::kNamedNumbers, notes);
  row.range = range;
  return row;
}

/// The options of a struct inside, by its own table.
template <auto Member>
constexpr OptionRow section(std::string_view name) {
  using Access = detail::Access<Member>;
  return {.name = name,
          .kind = OptionKind::kSection,
          .part = Access::part,
          .part_to_set = Access::part_to_set,
          .table = Access::table};
}

}  // namespace option

/// A rule over several fields, for `OptionTable::rule`.
template <auto Rule>
inline constexpr auto kRule = &option::detail::RuleAccess<decltype(Rule)>::template check<Rule>;

/// What `validate(options)` says. Fields are named within `section`.
template <class Options>
[[nodiscard]] Result<void> check_options(const Options& options, std::string_view section = {}) {
  return check_table(option_table(options), &options, section);
}

/// The defaults, and what `preset` names instead.
template <class Options>
[[nodiscard]] Options preset_options(PresetName preset) {
  Options options;
  set_preset(option_table(options), preset, &options);
  return options;
}

}  // namespace hypermap

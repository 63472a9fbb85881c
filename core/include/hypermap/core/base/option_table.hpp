// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What there is to know of each field of an options struct, said once: name, range, unit, source,
/// effect, and its value in the presets. Validation, presets, options files, `hypermap config` and
/// flags of the command line follow from it.
///
/// The owner of a struct defines `const OptionTable& option_table(const XOptions&)` beside it, with
/// the functions of `option_rows.hpp`. The default is the field's own, in the struct.
#pragma once

#include "hypermap/core/base/preset_name.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace hypermap {

/// A number that belongs to a name: the weight of a detector.
struct NamedNumber {
  std::string name;
  double number = 0.0;
  friend bool operator==(const NamedNumber&, const NamedNumber&) = default;
};

/// What a field holds. A scalar is a number, a flag 0 or 1, a choice the position of its name.
/// A view: lists stay where they are.
class OptionValue {
 public:
  using Numbers = std::span<const double>;
  using Names = std::span<const std::string>;
  using NamedNumbers = std::span<const NamedNumber>;

  constexpr OptionValue() noexcept = default;  ///< None: the field is empty.
  /// Implicit, so that a table says `.smap = 1.7`.
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  constexpr OptionValue(T scalar) noexcept  // NOLINT(google-explicit-constructor)
      : value_(static_cast<double>(scalar)) {}
  /// Probability, LogOdds.
  template <class T>
  requires requires(const T& strong) { strong.value(); }
  constexpr explicit OptionValue(const T& strong) noexcept : value_(strong.value()) {}
  constexpr explicit OptionValue(Numbers numbers) noexcept : value_(numbers) {}
  constexpr explicit OptionValue(Names names) noexcept : value_(names) {}
  constexpr explicit OptionValue(NamedNumbers numbers) noexcept : value_(numbers) {}

  [[nodiscard]] constexpr bool is_none() const noexcept { return value_.index() == 0; }
  /// Requires: a scalar, numbers, names, numbers by name.
  [[nodiscard]] constexpr double scalar() const { return std::get<double>(value_); }
  [[nodiscard]] constexpr Numbers numbers() const { return std::get<Numbers>(value_); }
  [[nodiscard]] constexpr Names names() const { return std::get<Names>(value_); }
  [[nodiscard]] constexpr NamedNumbers named_numbers() const {
    return std::get<NamedNumbers>(value_);
  }

 private:
  std::variant<std::monostate, double, Numbers, Names, NamedNumbers> value_;
};

/// Of a field that may be empty: it is.
inline constexpr OptionValue kNoValue{};

/// The end of a range that has none on that side. Infinity itself lies in it unless excluded.
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// An interval, and 0 beside it where 0 switches something off. NaN is in none.
struct OptionRange {
  double min = 0.0;
  double max = 1.0;
  bool excludes_min = false;
  bool excludes_max = false;
  bool includes_zero = false;  ///< Whatever the minimum is.

  [[nodiscard]] constexpr bool contains(double value) const noexcept {
    if (includes_zero && value == 0.0) return true;
    return (excludes_min ? value > min : value >= min) &&
           (excludes_max ? value < max : value <= max);
  }
};

/// "0 .. 1", "above 0 and at most 1", "0 or 0.0001 .. 10"; of an end that is unbounded: "at least
/// 1", "above 0 and finite" where infinity is excluded. "a number" when both ends are.
[[nodiscard]] std::string to_string(const OptionRange& range);

enum class OptionKind : std::uint8_t {
  kFlag,
  kCount,    ///< A whole number.
  kNumber,   ///< A real one, a probability or log-odds.
  kChoice,   ///< One of `OptionRow::choices`, named in the order of the enumerators from 0 on.
  kNumbers,  ///< As many as the field has.
  kNames,
  kNamedNumbers,  ///< A number for each name that is given, which is there once.
  kSection,       ///< Not an option, but a struct that has some.
};

struct OptionTable;

/// One option, or a section of them. All text is static.
struct OptionRow {
  std::string_view name;  ///< In errors and files; a section without one adds no level to them.
  OptionKind kind = OptionKind::kNumber;
  bool may_be_none = false;
  bool is_listed = true;  ///< By bind_options, for files and flags; else no matter of the result.
  OptionRange range = {};
  std::span<const std::string_view> choices = {};
  std::string_view unit = {};  ///< "m", "px", "log-odds" ...; empty for counts, shares, choices.
  std::string_view source = {};
  std::string_view effect = {};
  std::optional<OptionValue> smap = {};      ///< In that preset; none of these: the default.
  std::optional<OptionValue> hypermap = {};  ///< The same.

  /// Accessors to the field of the struct at that address, whose table this is.
  OptionValue (*get)(const void* options) = nullptr;
  void (*set)(void* options, const OptionValue& value) = nullptr;
  /// Of a section: its struct inside the one at that address, and its table.
  const void* (*part)(const void* options) = nullptr;
  void* (*part_to_set)(void* options) = nullptr;
  const OptionTable& (*table)(const void* part) = nullptr;
};

struct OptionTable {
  std::span<const OptionRow> rows;
  /// What binds several fields of the struct at that address; empty when nothing does.
  Result<void> (*rule)(const void* options) = nullptr;
};

/// "true, false", "names", "numbers by name", the names of a choice, or the interval: "none or 0 ..
/// 1".
[[nodiscard]] std::string range_text(const OptionRow& row);

/// Errors: kInvalidArgument, without a field: the rule that `value` breaks, and the value.
/// Requires: a value of the row's kind, or none.
[[nodiscard]] Result<void> check_value(const OptionRow& row, const OptionValue& value);

/// Errors: kInvalidArgument naming the first field out of its range, or the one that the rule of a
/// table names, as a field of `section` where that has a name. Requires: `options` is of the type
/// that the table is for. Cost: no allocation unless something is wrong.
[[nodiscard]] Result<void> check_table(const OptionTable& table,
                                       const void* options,
                                       std::string_view section = {});

/// The rule that one field lies above another. Errors: kInvalidArgument naming the upper one.
[[nodiscard]] Result<void> check_above(std::string_view lower_name,
                                       double lower,
                                       std::string_view upper_name,
                                       double upper);

/// Gives the fields that `preset` names its values; others stay. Requires: as check_table.
void set_preset(const OptionTable& table, PresetName preset, void* options);

/// One option of a struct, with all its sections before its name.
struct BoundOption {
  std::string name;  ///< "foreground.max_planes"
  const OptionRow* row = nullptr;
  void* options = nullptr;  ///< The struct that has the field.

  [[nodiscard]] OptionValue value() const { return row->get(options); }
  /// Requires: check_value(*row, value).
  void assign(const OptionValue& value) const { row->set(options, value); }
};

/// All listed options in the order of the table, bound to a struct. Requires: as check_table; the
/// struct outlives them.
[[nodiscard]] std::vector<BoundOption> bind_options(const OptionTable& table, void* options);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Flags that stand for options: names and limits are the options' own.
#pragma once

#include "hypermap/core/base/option_table.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/options/options_file.hpp"

#include <CLI/App.hpp>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap::app {

/// Accepts what an options file may say of the option `name`. Requires: there is one.
[[nodiscard]] CLI::Validator value_of_option(const std::string& name);

/// For `transform`: one_of the names of the option `name`.
/// Requires: there is one, and it is a choice.
[[nodiscard]] CLI::Validator choice_of_option(const std::string& name);

/// What a map's option is unless it is set, for the help of its flag. Requires: there is one.
[[nodiscard]] std::string default_of_option(const std::string& name);

/// Accepts a number that the field `name` of a struct with this table may hold.
/// Requires: the table has a count or number of that name in itself, not in a section.
[[nodiscard]] CLI::Validator value_of_field(const OptionTable& table, std::string_view name);

/// What a command line says of an option, if anything.
struct OptionFlag {
  std::string_view name;
  const std::optional<std::string>& text;
};

/// `options` as the flags that were given say. Errors: those of with_option.
[[nodiscard]] Result<MapOptions> with_flags(MapOptions options,
                                            std::initializer_list<OptionFlag> flags);

}  // namespace hypermap::app

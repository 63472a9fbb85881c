// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Flags that stand for options of a map: names and limits are the options' own.
#pragma once

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

/// What a command line says of an option, if anything.
struct OptionFlag {
  std::string_view name;
  const std::optional<std::string>& text;
};

/// `options` as the flags that were given say. Errors: those of with_option.
[[nodiscard]] Result<MapOptions> with_flags(MapOptions options,
                                            std::initializer_list<OptionFlag> flags);

}  // namespace hypermap::app

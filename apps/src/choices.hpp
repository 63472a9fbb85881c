// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Options that take one of some names.
#pragma once

#include <CLI/App.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::app {

/// For `transform`: accepts one of `names` in any spelling, as classes are, and gives the option
/// the one here. Another name is refused with all of them and the nearest.
[[nodiscard]] CLI::Validator one_of(std::vector<std::string> names);
[[nodiscard]] CLI::Validator one_of(std::span<const std::string_view> names);

/// The names that one_of gave the option; none when it has another validator, or none.
[[nodiscard]] std::vector<std::string> choices_of(const CLI::Option& option);

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "manual/command_text.hpp"

#include <string>
#include <string_view>

namespace hypermap::app {

/// A script by which bash completes commands, options of the command, choices, and files where a
/// value or an argument is neither. Needs bash 4, and nothing else.
[[nodiscard]] std::string bash_completion(const CommandText& program, std::string_view version);

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The program's manual, for man(1).
#pragma once

#include "command.hpp"
#include "manual/command_text.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap::app {

/// `text` as roff prints it and nothing else: no character of it is a command, a quotation mark or
/// a typographic one. Non-ASCII characters become \[uXXXX]. Requires: UTF-8, one line.
[[nodiscard]] std::string roff(std::string_view text);

struct ManPage {
  std::string name;  ///< "hypermap-map.1"
  std::string text;
};

/// A page for the program and one for each of its commands. No date stands in them.
[[nodiscard]] std::vector<ManPage> man_pages(const CommandText& program,
                                             std::span<const ExitStatus> statuses,
                                             std::string_view version);

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How a line that is typed at the shell may go on.
#pragma once

#include "shell_session.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap::app {

/// What the word at the cursor may become.
struct ShellCompletion {
  std::string open;                     ///< The word as far as it is typed, without quotes.
  char quote = '\0';                    ///< The quote that it stands in; NUL: none.
  std::vector<std::string> candidates;  ///< Whole words that begin so, ascending, each once.
};

/// Commands, and by the command files, layers, classes, ids and frames of what is read by now: a
/// completion reads no more of the map. Boundary: no candidates where a word is nothing of these.
[[nodiscard]] ShellCompletion complete(const ShellSession& session,
                                       std::string_view line_to_cursor);

/// What is to be typed at the cursor: what all candidates go on with, and behind the only one its
/// quote and a blank, but for a folder.
[[nodiscard]] std::string insertion_of(const ShellCompletion& completion);

}  // namespace hypermap::app

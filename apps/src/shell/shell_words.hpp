// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Words of a line that was typed at the shell.
///
/// Blanks separate words. Quotes of either kind keep blanks in a word, a backslash keeps the next
/// byte as it is (not within single quotes), and a word that begins with # begins a comment.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hypermap::app {

/// Errors: kInvalidArgument for a quote that is not closed, a backslash at the end, and for a
/// control character, NUL included. Boundary: no words of an empty line or a comment.
[[nodiscard]] Result<std::vector<std::string>> split_shell_line(std::string_view line);

/// A line up to the cursor, while it is typed.
struct OpenShellLine {
  std::vector<std::string> words;  ///< Before the one at the cursor.
  std::string open;                ///< The one at the cursor, as far as it is typed.
  char quote = '\0';               ///< The quote that it stands in; NUL: none.
  bool is_comment = false;
};

[[nodiscard]] OpenShellLine split_open_line(std::string_view line_to_cursor);

/// `text` as it is typed behind an opened `quote` (NUL: none), so that it reads as itself.
[[nodiscard]] std::string escaped(std::string_view text, char quote);

}  // namespace hypermap::app

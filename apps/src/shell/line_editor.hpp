// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lines that somebody types, with editing, history and completion.
#pragma once

#include "shell_completion.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace hypermap::app {

/// Of standard input and output. Keys are those of libedit, also as ~/.editrc binds them; Tab
/// completes. Sets the program's LC_CTYPE to UTF-8.
class LineEditor {
 public:
  using Completer = std::function<ShellCompletion(std::string_view line_to_cursor)>;

  /// None when the terminal cannot be used.
  [[nodiscard]] static std::optional<LineEditor> create(std::string prompt, Completer completer);
  ~LineEditor();
  LineEditor(LineEditor&&) noexcept;
  LineEditor& operator=(LineEditor&&) noexcept;
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  /// A line that can be gone back to.
  void remember(const std::string& line);

  enum class State { kLine, kEnd, kInterrupted };
  struct Line {
    State state = State::kEnd;
    std::string text = {};  ///< Without its end.
  };
  /// What is typed next; kInterrupted once SIGINT or SIGTERM came.
  [[nodiscard]] Line next();

 private:
  struct Terminal;
  explicit LineEditor(std::unique_ptr<Terminal> terminal);

  std::unique_ptr<Terminal> terminal_;
};

}  // namespace hypermap::app

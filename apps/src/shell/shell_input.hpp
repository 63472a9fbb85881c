// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bytes and lines that come in while a session waits.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <string>

namespace hypermap::app {

/// Longer lines are refused: a polygon of a hundred thousand vertices stays below it.
inline constexpr std::size_t kMaxShellLineBytes = std::size_t{1} << 22U;

/// How waiting ended.
enum class ShellInputState { kByte, kEnd, kInterrupted };

/// A descriptor that is read byte by byte, as they come.
class ShellInput {
 public:
  explicit ShellInput(int descriptor) : descriptor_(descriptor) {}

  struct Byte {
    ShellInputState state = ShellInputState::kEnd;
    char value = '\0';
  };
  /// The next byte; kInterrupted once SIGINT or SIGTERM came. Errors: kIo.
  [[nodiscard]] Result<Byte> next();

  struct Line {
    ShellInputState state = ShellInputState::kEnd;  ///< kByte: there is a line.
    std::string text = {};                          ///< Without its end, LF or CRLF.
    bool is_too_long = false;                       ///< Then without text.
  };
  /// The next line; the last one needs no end. Errors: kIo.
  [[nodiscard]] Result<Line> next_line();

 private:
  int descriptor_;
  std::string buffer_;
  std::size_t next_ = 0;  ///< In the buffer.
};

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lines of a text whose last line has its end too.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <string_view>

namespace hypermap {

/// Hands out the lines of a text, each with its end.
class TextLines {
 public:
  explicit TextLines(std::string_view text) : rest_(text) {}

  [[nodiscard]] bool done() const { return rest_.empty(); }
  [[nodiscard]] int number() const { return number_; }

  /// Errors: kMalformedFile for a last line without its end: the text was cut.
  [[nodiscard]] Result<std::string_view> take() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos)
      return fail(ErrorCode::kMalformedFile, "unexpected end in the middle of a line");
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    ++number_;
    return line;
  }

 private:
  std::string_view rest_;
  int number_ = 0;
};

}  // namespace hypermap

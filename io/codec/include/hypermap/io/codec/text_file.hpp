// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Lines, words and numbers of small text files, independent of the locale.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// One line without its end (LF or CRLF), comments not removed.
struct TextLine {
  int number = 0;  ///< 1-based
  std::string_view text;
};

/// Views into `text`. A missing end of the last line is no matter.
[[nodiscard]] std::vector<TextLine> split_lines(std::string_view text);

/// Words between blanks (space, tab, carriage return).
[[nodiscard]] std::vector<std::string_view> split_words(std::string_view line);

/// Without blanks on either side.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The whole of `text` as a number, infinities and NaN included; none when it is none or overflows.
[[nodiscard]] std::optional<double> parse_double(std::string_view text);

/// The whole of `text` as digits, leading zeros allowed; none when it is anything else.
[[nodiscard]] std::optional<std::uint64_t> parse_unsigned(std::string_view text);

/// A stamp as written, and in which unit.
struct ParsedStamp {
  Stamp stamp;
  bool is_in_nanoseconds = false;
  /// Written as a power of ten with nanoseconds: the last digits are likely lost.
  bool is_rounded = false;
};

/// Seconds, or nanoseconds when the number is 1e17 or more; read digit by digit, so that no double
/// rounds it. Digits beyond the nanosecond are rounded to the nearest.
/// Errors: kMalformedFile: no number, negative, not finite, or in neither unit's range.
[[nodiscard]] Result<ParsedStamp> parse_stamp(std::string_view text);

/// Seconds with nine digits at most, trailing zeros left out, so that `parse_stamp` gives it back.
/// Requires: stamp.ns >= 0.
[[nodiscard]] std::string stamp_text(Stamp stamp);

}  // namespace hypermap

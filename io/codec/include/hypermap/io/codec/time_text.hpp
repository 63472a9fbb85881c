// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Moments as people write and read them: seconds of a sequence's clock, dates in UTC.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"

#include <string>
#include <string_view>

namespace hypermap {

/// A moment as written.
struct WrittenTime {
  Stamp stamp = {};
  bool is_date = false;  ///< Written as a date: `stamp` counts from 1970.
  friend bool operator==(const WrittenTime&, const WrittenTime&) = default;
};

/// Seconds as `parse_stamp` takes them, or ISO 8601 in UTC: 2012-07-09T13:41:18.84Z, with as many
/// digits behind the point as there are, to nanoseconds, or without seconds.
/// Errors: kInvalidArgument naming `time`: neither of both, a day or an hour that does not exist
/// (60 seconds included), before 1970, after 2261.
[[nodiscard]] Result<WrittenTime> parse_time(std::string_view text);

/// Seconds with nine digits at most, trailing zeros left out; for a stamp that is not negative
/// `parse_time` gives it back. A number of JSON.
[[nodiscard]] std::string seconds_text(Stamp stamp);

/// Whether a stamp can count from 1970: no robot's own clock shows 2001 or later, by seconds since
/// it was switched on.
[[nodiscard]] bool is_since_1970(Stamp stamp);

/// As ISO 8601 in UTC, which `parse_time` gives back: 2012-07-09T13:41:18.84Z.
/// Requires: is_since_1970(stamp).
[[nodiscard]] std::string date_text(Stamp stamp);

}  // namespace hypermap

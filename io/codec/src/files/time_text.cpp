// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/codec/time_text.hpp"

#include "hypermap/io/codec/text_file.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

namespace hypermap {
namespace {

using std::chrono::seconds;
using std::chrono::sys_days;
using std::chrono::year_month_day;

constexpr std::int64_t kNsPerSecond = 1'000'000'000;
/// 2001-09-09T01:46:40Z.
constexpr std::int64_t kLeastSince1970Ns = 1'000'000'000 * kNsPerSecond;
constexpr int kLastYear = 2261;

/// Takes a number of so many digits from the front, and the character after it.
/// None when they are not there.
std::optional<int> take_number(std::string_view& text, std::size_t num_digits, char after) {
  if (text.size() <= num_digits || text[num_digits] != after) return std::nullopt;
  const auto number = parse_unsigned(text.substr(0, num_digits));
  if (!number) return std::nullopt;
  text.remove_prefix(num_digits + 1);
  return static_cast<int>(*number);
}

/// "18", "18.84": seconds below 60. None of anything else.
std::optional<std::int64_t> seconds_ns(std::string_view text) {
  const bool is_form =
      text.size() >= 2 && (text.size() == 2 || (text.size() > 3 && text[2] == '.'));
  const auto is_other = [](char c) { return c != '.' && (c < '0' || c > '9'); };
  if (!is_form || std::ranges::any_of(text, is_other)) return std::nullopt;
  const auto stamp = parse_stamp(text);
  if (!stamp || stamp->is_in_nanoseconds || stamp->stamp.ns >= 60 * kNsPerSecond)
    return std::nullopt;
  return stamp->stamp.ns;
}

/// "2012-07-09T13:41Z", "2012-07-09T13:41:18.84Z". None of anything else.
std::optional<Stamp> stamp_of_date(std::string_view text) {
  const auto year = take_number(text, 4, '-');
  const auto month = take_number(text, 2, '-');
  const auto day = take_number(text, 2, 'T');
  const auto hour = take_number(text, 2, ':');
  if (!year || !month || !day || !hour || !text.ends_with('Z')) return std::nullopt;
  text.remove_suffix(1);
  const auto minute = parse_unsigned(text.substr(0, 2));
  if (!minute || text.size() < 2 || *hour > 23 || *minute > 59) return std::nullopt;
  text.remove_prefix(2);
  std::optional<std::int64_t> rest = 0;
  if (!text.empty()) rest = text.starts_with(':') ? seconds_ns(text.substr(1)) : std::nullopt;
  const year_month_day date{std::chrono::year(*year),
                            std::chrono::month(static_cast<unsigned>(*month)),
                            std::chrono::day(static_cast<unsigned>(*day))};
  if (!rest || !date.ok() || *year < 1970 || *year > kLastYear) return std::nullopt;
  const std::int64_t days = sys_days(date).time_since_epoch().count();
  const std::int64_t minutes = (days * 24 + *hour) * 60 + static_cast<std::int64_t>(*minute);
  return Stamp{minutes * 60 * kNsPerSecond + *rest};
}

std::string padded(std::int64_t number, std::size_t width) {
  std::string text = std::to_string(number);
  if (text.size() < width) text.insert(0, width - text.size(), '0');
  return text;
}

}  // namespace

Result<WrittenTime> parse_time(std::string_view text) {
  if (const auto date = stamp_of_date(text)) return WrittenTime{.stamp = *date, .is_date = true};
  if (const auto stamp = parse_stamp(text)) return WrittenTime{.stamp = stamp->stamp};
  return fail(ErrorCode::kInvalidArgument,
              "must be seconds (12.5) or a date in UTC (2012-07-09T13:41:18Z), is '" +
                  printable(text, 60) + "'",
              "time");
}

std::string seconds_text(Stamp stamp) {
  if (stamp.ns >= 0) return stamp_text(stamp);
  // The magnitude of the least number is none of its own type.
  const std::uint64_t ns = ~static_cast<std::uint64_t>(stamp.ns) + 1U;
  const auto per_second = static_cast<std::uint64_t>(kNsPerSecond);
  const std::string whole = std::to_string(ns / per_second);
  const std::string rest = stamp_text(Stamp{static_cast<std::int64_t>(ns % per_second)});
  return "-" + whole + rest.substr(1);
}

bool is_since_1970(Stamp stamp) {
  return stamp.ns >= kLeastSince1970Ns;
}

std::string date_text(Stamp stamp) {
  const std::int64_t whole_s = stamp.ns / kNsPerSecond;
  const std::int64_t second_of_day = whole_s % 86400;
  const year_month_day date{
      std::chrono::floor<std::chrono::days>(std::chrono::sys_seconds(seconds(whole_s)))};
  std::string fraction = stamp_text(Stamp{stamp.ns % kNsPerSecond}).substr(1);  // from the point on
  if (fraction == ".0") fraction.clear();
  return padded(static_cast<int>(date.year()), 4) + "-" +
         padded(static_cast<unsigned>(date.month()), 2) + "-" +
         padded(static_cast<unsigned>(date.day()), 2) + "T" + padded(second_of_day / 3600, 2) +
         ":" + padded(second_of_day / 60 % 60, 2) + ":" + padded(second_of_day % 60, 2) + fraction +
         "Z";
}

}  // namespace hypermap

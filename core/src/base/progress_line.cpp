// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/progress_line.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace hypermap {
namespace {

constexpr double kWindowS = 30.0;
constexpr double kSampleEveryS = 0.5;
constexpr double kMinSpanS = 2.0;
constexpr std::size_t kMinUnits = 3;
constexpr double kMaxHours = 1000.0;

/// Whatever the locale is.
std::string with_decimals(double value, int decimals) {
  std::array<char, 64> buffer{};
  const auto [end, error] = std::to_chars(
      buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  return {buffer.data(), error == std::errc{} ? end : buffer.data()};
}

std::string two_digits(std::uint64_t number) {
  const std::string digits = std::to_string(number);
  return digits.size() < 2 ? "0" + digits : digits;
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds > kMaxHours * 3600.0) return "over 1000 h";
  const auto whole_s = static_cast<std::uint64_t>(std::ceil(seconds));
  if (whole_s < 60) return std::to_string(whole_s) + " s";
  if (whole_s < 3600) {
    return std::to_string(whole_s / 60) + " min " + two_digits(whole_s % 60) + " s";
  }
  const std::uint64_t minutes = (whole_s + 59) / 60;
  return std::to_string(minutes / 60) + " h " + two_digits(minutes % 60) + " min";
}

std::string rate_text(double per_second) {
  // What would be rounded to 100.0 or 1.0 has the form of these.
  if (per_second >= 99.95) return with_decimals(per_second, 0) + " a second";
  if (per_second >= 0.95) return with_decimals(per_second, 1) + " a second";
  const double seconds = 1.0 / per_second;
  if (seconds < 59.95) return with_decimals(seconds, 1) + " s each";
  return duration_text(seconds) + " each";
}

std::string progress_text(const std::string& what,
                          std::size_t done,
                          std::size_t total,
                          std::optional<double> per_second) {
  std::string text = what + " " + std::to_string(done) + "/" + std::to_string(total) + " (" +
                     std::to_string(100 * done / total) + " %)";
  if (!per_second) return text;
  text += ", " + rate_text(*per_second);
  if (done == total) return text;
  return text + ", " + duration_text(static_cast<double>(total - done) / *per_second) + " left";
}

void ProgressRate::note(double now_s, std::size_t done) {
  newest_ = {now_s, done};
  if (past_.empty() || now_s - past_.back().time_s >= kSampleEveryS) past_.push_back(newest_);
  const auto is_enough = [&](const Sample& since) {
    return now_s - since.time_s >= kWindowS && done - since.done >= kMinUnits;
  };
  while (past_.size() > 1 && is_enough(past_[1])) past_.pop_front();
}

std::optional<double> ProgressRate::per_second() const {
  if (past_.empty()) return std::nullopt;
  const Sample& since = past_.front();
  const double span_s = newest_.time_s - since.time_s;
  const std::size_t num_units = newest_.done - since.done;
  if (num_units < kMinUnits || !(span_s >= kMinSpanS)) return std::nullopt;
  return static_cast<double>(num_units) / span_s;
}

std::optional<std::string> ProgressLine::update(double now_s, std::size_t done, std::size_t total) {
  if (total == 0) return std::nullopt;
  rate_.note(now_s, done);
  const std::size_t percent = 100 * done / total;
  if (percent == shown_percent_ && now_s - shown_s_ < refresh_s_) return std::nullopt;
  shown_percent_ = percent;
  shown_s_ = now_s;
  return progress_text(what_, done, total, rate_.per_second());
}

}  // namespace hypermap

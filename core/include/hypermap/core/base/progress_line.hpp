// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far long work has come, how fast it goes and how long it will take, in one line of text.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {

/// "8 s", "3 min 05 s", "2 h 05 min", "over 1000 h": rounded up to the last unit that is shown.
/// Requires: seconds >= 0, infinity included.
[[nodiscard]] std::string duration_text(double seconds);

/// "412 a second", "41.2 a second"; below one "1.3 s each" or, from a minute on, "3 min 05 s each".
/// Requires: per_second > 0 and finite.
[[nodiscard]] std::string rate_text(double per_second);

/// "mapping 120/200 (60 %), 41.2 a second, 2 s left"; without rate and time while `per_second` is
/// none, without the time when all is done. Requires: total > 0, done <= total.
[[nodiscard]] std::string progress_text(const std::string& what,
                                        std::size_t done,
                                        std::size_t total,
                                        std::optional<double> per_second);

/// Units a second, over the last half minute or, where they are slow, the last three units.
class ProgressRate {
 public:
  /// `done` units are done at `now_s`, by a clock that never goes back. Where the first call says
  /// work to be, it begins: what was done before tells nothing of the rate.
  void note(double now_s, std::size_t done);
  /// None until three units and two seconds have passed. Above 0 and finite.
  [[nodiscard]] std::optional<double> per_second() const;

 private:
  struct Sample {
    double time_s = 0.0;
    std::size_t done = 0;
  };
  std::deque<Sample> past_;  ///< Half a second apart at least.
  Sample newest_;
};

/// The line and when it is due. Times come from the caller, so nothing here depends on a clock.
class ProgressLine {
 public:
  /// A line is due with each new per cent, and `refresh_s` after the last one; infinity: never.
  ProgressLine(std::string what, double refresh_s)
      : what_(std::move(what)), refresh_s_(refresh_s) {}

  /// The line to show, if one is due, when `done` of `total` units are done at `now_s`.
  /// Boundary: nothing of nothing has no line. Requires: done <= total.
  [[nodiscard]] std::optional<std::string> update(double now_s,
                                                  std::size_t done,
                                                  std::size_t total);

 private:
  std::string what_;
  double refresh_s_;
  ProgressRate rate_;
  std::optional<std::size_t> shown_percent_;
  double shown_s_ = 0.0;
};

}  // namespace hypermap

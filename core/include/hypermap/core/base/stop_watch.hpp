// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How long something takes, by a clock that the caller may choose.
#pragma once

#include <chrono>
#include <functional>
#include <utility>

namespace hypermap {

/// Seconds since some moment of its own; never goes back. Called by one thread at a time.
using Clock = std::function<double()>;

/// The time that passes for people, whatever is done to the system's date.
[[nodiscard]] inline double wall_clock_s() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

/// Takes times. For reports and live deadlines; no map may depend on it otherwise.
class StopWatch {
 public:
  explicit StopWatch(Clock clock = wall_clock_s) : clock_(std::move(clock)), start_(clock_()) {}

  /// Since the last call, the first time since the start. Unit: second.
  [[nodiscard]] double lap() {
    const double now = clock_();
    return now - std::exchange(last_, now);
  }
  /// Since the start. Unit: second.
  [[nodiscard]] double elapsed_s() const { return clock_() - start_; }

 private:
  Clock clock_;
  double start_;
  double last_ = start_;
};

}  // namespace hypermap

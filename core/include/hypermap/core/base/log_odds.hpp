// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Probability and log-odds as two types that never convert silently.
///
/// Source: [smap] Eq. (3.10), (3.11).
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <compare>

namespace hypermap {

/// A probability in the closed interval [0, 1]. Never NaN.
class Probability {
 public:
  constexpr Probability() noexcept = default;  ///< Unknown: 0.5.
  /// Requires: p in [0, 1]. Numbers from files and detectors are checked at the door, where the
  /// error can name file and field; inside, a Probability is a promise.
  constexpr explicit Probability(double p) noexcept : value_(p) { assert(p >= 0.0 && p <= 1.0); }
  [[nodiscard]] constexpr double value() const noexcept { return value_; }
  friend constexpr auto operator<=>(Probability, Probability) = default;

 private:
  double value_ = 0.5;
};

/// Log-odds l = ln(p / (1 - p)), natural logarithm. l > 0 means "more likely than not".
///
/// Addition is Bayesian fusion of independent evidence under a prior of 0.5.
class LogOdds {
 public:
  constexpr LogOdds() noexcept = default;  ///< Unknown: l = 0, p = 0.5.
  constexpr explicit LogOdds(double l) noexcept : value_(l) {}

  /// Source: [smap] Eq. (3.10). Boundary: p = 0 gives -infinity and p = 1 gives +infinity.
  [[nodiscard]] static LogOdds of(Probability p) noexcept {
    return LogOdds(std::log(p.value()) - std::log1p(-p.value()));
  }
  /// Source: [smap] Eq. (3.11), written 1 / (1 + e^-l) so that large |l| cannot overflow.
  [[nodiscard]] Probability probability() const noexcept {
    return Probability(1.0 / (1.0 + std::exp(-value_)));
  }

  [[nodiscard]] constexpr double value() const noexcept { return value_; }
  constexpr LogOdds& operator+=(LogOdds rhs) noexcept {
    value_ += rhs.value_;
    return *this;
  }
  constexpr LogOdds& operator-=(LogOdds rhs) noexcept {
    value_ -= rhs.value_;
    return *this;
  }
  friend constexpr LogOdds operator+(LogOdds a, LogOdds b) noexcept { return a += b; }
  friend constexpr LogOdds operator-(LogOdds a, LogOdds b) noexcept { return a -= b; }
  friend constexpr LogOdds operator*(double scale, LogOdds l) noexcept {
    return LogOdds(scale * l.value_);
  }
  friend constexpr auto operator<=>(LogOdds, LogOdds) = default;

 private:
  double value_ = 0.0;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Quartiles of a series of any length in bounded memory.
#pragma once

#include "hypermap/core/base/five_numbers.hpp"

#include <cstddef>
#include <vector>

namespace hypermap {

/// Keeps every k-th value of a series, from the first on: k is 1 up to kCapacity values and doubles
/// each time that they would be more. So what is kept depends on the series alone, is spread over
/// all of it, and is half the capacity or more once that was reached. Values: not NaN.
class SeriesSample {
 public:
  static constexpr std::size_t kCapacity = 4096;

  /// Cost: amortised O(1).
  void add(double value);

  /// Values that were added.
  [[nodiscard]] std::size_t n() const { return n_; }
  /// k: of as many values one is kept.
  [[nodiscard]] std::size_t stride() const { return stride_; }
  /// Minimum and maximum of all values, quartiles of those that are kept: of all up to kCapacity.
  /// Boundary: all 0 without values. Cost: O(k log k) for k kept ones.
  [[nodiscard]] FiveNumbers numbers() const;

 private:
  std::vector<double> kept_;
  std::size_t n_ = 0;
  std::size_t stride_ = 1;
  double min_ = 0.0;
  double max_ = 0.0;
};

}  // namespace hypermap

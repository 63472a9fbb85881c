// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Minimum, quartiles and maximum of a sample.
///
/// Source: [smap] C.7 (box plots).
#pragma once

#include <span>

namespace hypermap {

/// Five numbers that a box plot draws.
struct FiveNumbers {
  double min = 0.0;
  double lower = 0.0;  ///< A quarter of the sample is less.
  double median = 0.0;
  double upper = 0.0;  ///< Three quarters of the sample are less.
  double max = 0.0;
  friend bool operator==(const FiveNumbers&, const FiveNumbers&) = default;
};

/// Between two values of the sample quartiles lie on the line, as in most statistics programs: of n
/// values in order, the quantile q is at place q (n - 1).
/// Requires: no value is NaN. Boundary: of an empty sample all are 0. Cost: O(n log n).
[[nodiscard]] FiveNumbers five_numbers(std::span<const double> sample);

}  // namespace hypermap

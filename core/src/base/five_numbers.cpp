// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/five_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hypermap {
namespace {

/// Requires: ascending, not empty; 0 <= q <= 1.
double quantile(const std::vector<double>& sorted, double q) {
  const double place = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], place - static_cast<double>(below));
}

}  // namespace

FiveNumbers five_numbers(std::span<const double> sample) {
  if (sample.empty()) return {};
  std::vector<double> sorted(sample.begin(), sample.end());
  std::ranges::sort(sorted);
  return {.min = sorted.front(),
          .lower = quantile(sorted, 0.25),
          .median = quantile(sorted, 0.5),
          .upper = quantile(sorted, 0.75),
          .max = sorted.back()};
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether one map is better than another, or only by chance.
///
/// Source: [hypermap] 5.2.1, paired one-sided Wilcoxon signed-rank test.
#pragma once

#include "hypermap/core/base/result.hpp"

#include <cstddef>
#include <span>

namespace hypermap {

struct WilcoxonResult {
  std::size_t n = 0;      ///< Pairs that differ.
  double rank_sum = 0.0;  ///< W+: sum of the ranks of the pairs with a > b.
  double p = 1.0;         ///< Chance of a rank sum this large when the median difference is 0.
  bool exact = true;      ///< From the exact distribution; else from the normal approximation.
};

/// Tests against "a is not larger than b". Pairs without a difference are left out, equal absolute
/// differences share the mean of their ranks.
///
/// Exact up to 30 differing pairs (ties included: all sign patterns count), beyond by the normal
/// approximation with correction for ties and continuity.
/// Boundary: no differing pair gives p = 1.
/// Errors: kInvalidArgument when the lengths differ or a number is not finite.
[[nodiscard]] Result<WilcoxonResult> wilcoxon_one_sided(std::span<const double> a,
                                                        std::span<const double> b);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One-to-one assignment where few pairs may be made.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

/// A member of one side with one of the other.
struct IndexPair {
  std::size_t row = 0;
  std::size_t column = 0;
};

/// A pair that may be made.
struct CostedPair {
  IndexPair pair;
  double cost = 0.0;
};

/// As `assign`: as many of the pairs as possible, then the least sum of costs. Each pair stands
/// there once, in any order.
/// Cost: that of `assign` for each set of members that are connected by pairs, and so almost linear
/// where candidates are near each other and sets are small.
[[nodiscard]] std::vector<IndexPair> assign_sparse(std::span<const CostedPair> candidates);

}  // namespace hypermap

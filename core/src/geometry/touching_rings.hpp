// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rings of a polygon that touch each other in common corners, as a hole does that reaches an edge.
///
/// Source: OGC 06-103r4, 6.1.11.1 (rings of a polygon may intersect in points, as tangents).
#pragma once

#include "hypermap/core/base/load_budget.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <cstddef>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace hypermap {

/// Pairs of rings, the smaller index first.
using RingPairs = std::set<std::pair<std::size_t, std::size_t>>;

/// The pairs of rings that touch, when no ring meets itself and two rings meet in common corners
/// only, where each lies on the left of the other; none when they meet in any other way.
///
/// Boundary: decided exactly. More than 4,096 points in all are not looked at: none.
/// Requires: the first ring counter-clockwise, the others clockwise, as cleaned_ring gives them.
/// Errors: those of LoadBudget::draw_edge_tests. Cost: O(n^2), drawn from `budget`.
[[nodiscard]] Result<std::optional<RingPairs>> touching_pairs(std::span<const Ring> rings,
                                                              const LoadBudget& budget);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether rings cross or touch themselves or each other, in bounded time for any input.
///
/// Source: M. I. Shamos, D. Hoey, "Geometric intersection problems", 1976.
#pragma once

#include "hypermap/core/geometry/polygon.hpp"

#include <optional>
#include <span>

namespace hypermap {

/// A point at or beside the first place, from the left, where rings meet themselves or each other;
/// none when all are simple and apart. Requires: finite coordinates, at least three points a ring,
/// no two consecutive ones equal. Cost: O(n log n).
[[nodiscard]] std::optional<Eigen::Vector2d> first_intersection(std::span<const Ring> rings);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The first check of a ring: common to the strict and the lenient reader.
#pragma once

#include "hypermap/core/geometry/polygon.hpp"

#include <cstddef>
#include <string>

namespace hypermap {

inline constexpr std::size_t kMaxPolygonPoints = 100'000;
/// Of a ring that crosses itself, and of rings that touch: all their edges are compared.
inline constexpr std::size_t kMaxCrossingPoints = 4096;
inline constexpr double kMaxCoordinateM = 1e6;

/// Without the repeated closing point and other repeated consecutive points.
///
/// Errors: kInvalidArgument: a coordinate that is not finite or beyond 1e6 m, fewer than three
/// distinct points, a spike (the way goes straight back).
[[nodiscard]] Result<Ring> cleaned_ring(Ring ring);

/// Positive when counter-clockwise, but for rounding.
[[nodiscard]] double signed_area_m2(const Ring& ring);

/// Which way the ring turns, exactly. Requires: cleaned_ring that does not cross itself.
[[nodiscard]] bool is_counter_clockwise(const Ring& ring);

/// "(x, y)" with the shortest digits that give the same numbers.
[[nodiscard]] std::string point_text(const Eigen::Vector2d& point);

}  // namespace hypermap

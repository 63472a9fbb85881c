// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// On which side of a line a point lies, without rounding errors.
///
/// Source: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
/// Predicates", 1997 (error-free products and sums).
#pragma once

#include <Eigen/Core>

namespace hypermap {

/// 1 when c lies to the left of a -> b, -1 to the right, 0 exactly on the line.
/// Requires: finite coordinates whose products neither overflow nor underflow.
[[nodiscard]] int orientation(const Eigen::Vector2d& a,
                              const Eigen::Vector2d& b,
                              const Eigen::Vector2d& c);

/// Whether the closed segments a-b and c-d have a point in common.
[[nodiscard]] bool segments_intersect(const Eigen::Vector2d& a,
                                      const Eigen::Vector2d& b,
                                      const Eigen::Vector2d& c,
                                      const Eigen::Vector2d& d);

}  // namespace hypermap

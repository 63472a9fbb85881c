// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A point of the map in single precision, as OctoMap keeps it.
#pragma once

#include <array>
#include <cstddef>

namespace hypermap {

using PointF = std::array<float, 3>;

[[nodiscard]] inline PointF difference(const PointF& a, const PointF& b) noexcept {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
[[nodiscard]] inline float squared_norm(const PointF& a) noexcept {
  return a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Numbers of cells in inner loops.
#pragma once

#include <cstdint>

namespace hypermap {

/// std::floor without a call into the C library; the same for all that fits.
[[nodiscard]] inline std::int64_t floor_of(double x) noexcept {
  const auto towards_zero = static_cast<std::int64_t>(x);
  return towards_zero - (static_cast<double>(towards_zero) > x ? 1 : 0);
}

}  // namespace hypermap

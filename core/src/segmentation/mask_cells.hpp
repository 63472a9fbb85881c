// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Cells of a depth window that are marked.
#pragma once

#include "depth_window.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// Networks' masks are off by this at their edge: they are made at a quarter of the resolution.
/// Unit: pixel.
inline constexpr double kMaskTolerancePx = 6.0;

/// 1 on the cells within `reach` columns and rows of a marked one.
/// Requires: a mark a cell. Cost: O(cells).
[[nodiscard]] std::vector<std::uint8_t> widened(const DepthWindow& window,
                                                const std::vector<std::uint8_t>& marks,
                                                int reach);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far each cell of a mask is from what the mask leaves out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// Cells of a grid that are in or out. Shape: rows x cols, row-major.
struct CellMask {
  int cols = 0;
  int rows = 0;
  std::vector<std::uint8_t> is_in;
};

/// Of each cell in the mask the squared distance, in cells, to the middle of the nearest cell that
/// is not, of cells outside 0. What is beyond the grid is not in the mask.
///
/// Source: P. Felzenszwalb and D. Huttenlocher, "Distance Transforms of Sampled Functions", 2012.
/// Exact. Cost: O(cells).
[[nodiscard]] std::vector<std::int64_t> squared_clearance(const CellMask& mask);

}  // namespace hypermap

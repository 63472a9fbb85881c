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

/// What lies beyond the grid of a mask.
enum class BeyondGrid : std::uint8_t { kOut, kIn };

/// Of each cell in the mask the squared distance, in cells, to the middle of the nearest cell that
/// is not, of cells outside 0. What is beyond the grid is not in the mask unless that is said.
///
/// Source: P. Felzenszwalb and D. Huttenlocher, "Distance Transforms of Sampled Functions", 2012.
/// Exact. Boundary: (cols + rows + 2)^2 where no cell is out. Cost: O(cells).
[[nodiscard]] std::vector<std::int64_t> squared_clearance(const CellMask& mask,
                                                          BeyondGrid beyond = BeyondGrid::kOut);

/// From the middle of a cell to the nearest edge of one whose middle is so far away, in cells.
[[nodiscard]] double gap_in_cells(std::int64_t squared);

}  // namespace hypermap

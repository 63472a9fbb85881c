// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The cells that share an edge with a cell.
#pragma once

#include <cstddef>

namespace hypermap {

/// Calls `visit` with their places in row-major order, ascending. Requires: `cell` is in the grid.
template <class Visit>
void for_each_neighbour(int cols, int rows, std::size_t cell, const Visit& visit) {
  const auto width = static_cast<std::size_t>(cols);
  const std::size_t row = cell / width;
  const std::size_t col = cell % width;
  if (row > 0) visit(cell - width);
  if (col > 0) visit(cell - 1);
  if (col + 1 < width) visit(cell + 1);
  if (row + 1 < static_cast<std::size_t>(rows)) visit(cell + width);
}

}  // namespace hypermap

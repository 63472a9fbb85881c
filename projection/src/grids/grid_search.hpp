// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The shortest ways over cells from one cell, as far as somebody wants to know.
#pragma once

#include "hypermap/projection/grids/free_space.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace hypermap {

/// Called with each cell's place in row-major order and its distance in cells, the nearest first;
/// whether to go on.
using SearchVisitor = std::function<bool(std::size_t place, double cells)>;

/// What a search found of the cells that it came to.
class GridSearch {
 public:
  /// Dijkstra over eight neighbours: a step along an edge is 1, over a corner root 2, and that only
  /// where both cells beside it are fit too. Of equally near cells the first in row-major order
  /// comes first. Requires: space.fits(start). Cost: O(n log n) for n visited cells; 9 bytes a cell
  /// of the grid.
  GridSearch(const FreeSpace& space, Cell start, const SearchVisitor& visit);

  /// From the start to a cell that was visited, both included.
  [[nodiscard]] std::vector<Cell> way_to(std::size_t place) const;

 private:
  void relax(const FreeSpace& space, Cell from, double cells, int step);
  [[nodiscard]] Cell cell_of(std::size_t place) const;

  GridGeometry geometry_;
  std::vector<double> cells_;       ///< Distance of each cell; infinite where none is known.
  std::vector<std::uint8_t> step_;  ///< By which the shortest way came to it; kNoStep: none did.
  std::vector<std::pair<double, std::size_t>> heap_;  ///< What is to be visited.
};

/// Whether the robot fits in each cell that the straight line between the middles of two crosses,
/// those beside a corner that it passes exactly included.
[[nodiscard]] bool is_straight_free(const FreeSpace& space, Cell from, Cell to);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Cells whose column was looked through but for a level at which a surface beside it goes on.
#pragma once

#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/projection/grids/occupancy_projection.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// What was seen of the columns over a grid, level by level.
///
/// Rays that pass below and above the top of a table clear all of its column but the top itself,
/// where its edge was measured and the rest was not. Such a level of a cell is hidden when
/// something thin was measured at its height beside it: a top, a seat, a shelf. A wall is not thin,
/// so that what no picture reached beside it is not hidden by it.
class HiddenLevels {
 public:
  /// Nothing was seen yet. Requires: level_edge_m > 0, the edge of the smallest leaves.
  HiddenLevels(const GridGeometry& geometry, const HeightBand& band, double level_edge_m);

  /// The levels that a leaf reaches into, as bits from the band's lowest one; none outside it.
  [[nodiscard]] std::uint64_t levels_of(const LeafSample& leaf) const;
  /// Requires: `levels` are those of the leaf, `cell` of the geometry is below it.
  void add(Cell cell, const LeafSample& leaf, std::uint64_t levels);

  /// The cells that hide a level. Takes what was added. Cost: O(cells).
  [[nodiscard]] std::vector<bool> take_hidden_cells() &&;

 private:
  /// Levels of a cell at which a surface goes on into its neighbours.
  struct Front {
    std::size_t cell = 0;
    std::uint64_t levels = 0;
  };
  [[nodiscard]] std::vector<Front> find_edges();

  GridGeometry geometry_;
  double level_edge_m_;  ///< That of the leaves, or that doubled until the band has few enough.
  double first_ = 0.0;   ///< Number of the lowest level from the map's origin.
  int num_levels_ = 0;
  std::vector<std::uint64_t> free_;      ///< By cell: bit i, level i was looked through.
  std::vector<std::uint64_t> occupied_;  ///< By cell: bit i, something was measured at level i.
};

}  // namespace hypermap

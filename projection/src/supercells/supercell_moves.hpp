// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Supercells while they exchange blocks: what a move would change, whether it may be made, and the
/// energy after it.
///
/// Source: [sogm] Eq. (7), Eq. (10); [seeds] 3.2 (contour reward), 4 (block and pixel moves).
#pragma once

#include "binned_cells.hpp"
#include "hypermap/projection/supercells/supercells.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace hypermap {

/// A square of 2^level cells, cut off at the edges of the grid, by its place among its like.
struct Block {
  int col = 0;
  int row = 0;
};

/// Refers to the cells.
class SupercellMoves {
 public:
  /// Squares of 2^num_levels cells; blocks of half that edge. Requires: valid options, cells that
  /// outlive it.
  SupercellMoves(const BinnedCells& cells, const SupercellOptions& options);

  /// Goes on with blocks of 2^level cells. Requires: not larger than those before.
  void set_level(int level);
  [[nodiscard]] int block_cols() const noexcept { return block_cols_; }
  [[nodiscard]] int block_rows() const noexcept { return block_rows_; }

  [[nodiscard]] int label(Block block) const;
  /// The supercells of the four blocks beside it; -1 outside. In the order right, up, left, down.
  [[nodiscard]] std::array<int, 4> labels_beside(Block block) const;
  /// Whether the block's supercell stays connected and not empty without it, and has a variance.
  [[nodiscard]] bool may_leave(Block block) const;
  /// What counts for a move: negative is better. Requires: the block may leave for this neighbour.
  [[nodiscard]] double energy_change(Block block, int to);
  /// Requires: as energy_change.
  void move(Block block, int to);

  /// H = sum of D' - gamma G, kept up to date by each move.
  [[nodiscard]] double energy() const noexcept { return energy_; }
  [[nodiscard]] int count() const noexcept { return static_cast<int>(supercells_.size()); }
  [[nodiscard]] const std::vector<std::int32_t>& labels() const noexcept { return labels_; }

 private:
  /// Cells from (left, low) to before (right, high).
  struct CellRect {
    int left = 0;
    int low = 0;
    int right = 0;
    int high = 0;
  };
  /// By how much D' of the supercell changes with `sign` times the cells.
  [[nodiscard]] double variance_change(int label, const CellSums& set, int sign) const;
  [[nodiscard]] double contour_change(const CellRect& rect, int from, int to) const;
  [[nodiscard]] double contour_around(const CellRect& rect, int label_inside) const;
  [[nodiscard]] double contour_at(int col, int row, const CellRect& rect, int label_inside) const;
  [[nodiscard]] CellRect rect_of(Block block) const;
  /// Valid until the next call.
  [[nodiscard]] const CellSums& set_of(Block block);
  [[nodiscard]] std::size_t cell_index(int col, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_->cols) +
           static_cast<std::size_t>(col);
  }

  const BinnedCells* cells_;
  SupercellOptions options_;
  std::vector<std::int32_t> labels_;
  std::vector<CellSums> supercells_;
  std::vector<CellSums> blocks_;  ///< Of this level; none where they are single cells.
  CellSums cell_;                 ///< Working memory for a block that is a single cell.
  int level_ = 0;
  int block_cols_ = 0;
  int block_rows_ = 0;
  double energy_ = 0.0;
};

}  // namespace hypermap

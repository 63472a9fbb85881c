// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Supercells while they exchange blocks: what a move would change, whether it may be made, and the
/// energy after it.
///
/// Source: [sogm] Eq. (7), Eq. (10); [seeds] 3.2 (contour reward), 4 (block and pixel moves).
#pragma once

#include "binned_cells.hpp"
#include "contour_reward.hpp"
#include "hypermap/projection/supercells/supercells.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

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

  [[nodiscard]] int label(Block block) const {
    return labels_[cell_index(block.col << level_, block.row << level_)];
  }
  /// The supercells of the four blocks beside it; -1 outside. In the order right, up, left, down.
  [[nodiscard]] std::array<int, 4> labels_beside(Block block) const;
  /// Whether the block's supercell stays connected and not empty without it, and has a variance.
  [[nodiscard]] bool may_leave(Block block) const;
  /// What counts for a move: negative is better. Requires: the block may leave for this neighbour.
  [[nodiscard]] double energy_change(Block block, int to);
  /// The neighbour by whose taking the block most is won; of equals the one of the smallest number.
  /// None when nothing is won, or the block may not leave, or nothing that counts has changed since
  /// it was asked for the last time on this level.
  [[nodiscard]] std::optional<int> best_taker(Block block);
  /// Requires: as energy_change.
  void move(Block block, int to);

  /// H = sum of D' - gamma G, kept up to date by each move. With
  /// cells counted, n^(3/4) sqrt(D') instead of D'.
  [[nodiscard]] double energy() const noexcept { return energy_; }
  [[nodiscard]] int count() const noexcept { return static_cast<int>(terms_.size()); }
  [[nodiscard]] const std::vector<std::int32_t>& labels() const noexcept { return labels_; }

 private:
  /// The terms of a move's energy change, all but gamma times the pull of the taker.
  [[nodiscard]] double cost_of_leaving(Block block, SetSums set) const;
  [[nodiscard]] double cost_of_joining(Block block, SetSums set, int to) const;
  /// What a variance over so many cells counts in the energy.
  [[nodiscard]] double weighted(double variance, std::int64_t num_cells) const;
  /// By how much the supercell's term changes with `sign` times the cells.
  [[nodiscard]] double term_change(int label, SetSums set, int sign) const;
  [[nodiscard]] bool stays_connected(Block block, const std::array<int, 4>& beside) const;
  /// Whether a supercell at the block has changed since this was asked last of this block.
  [[nodiscard]] bool is_news(Block block, const std::array<int, 4>& beside);
  void update_supercell(int label);
  /// Valid until the next call.
  [[nodiscard]] SetSums set_of(Block block);
  [[nodiscard]] std::size_t block_index(Block block) const noexcept {
    return static_cast<std::size_t>(block.row) * static_cast<std::size_t>(block_cols_) +
           static_cast<std::size_t>(block.col);
  }
  [[nodiscard]] std::size_t cell_index(int col, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_->cols) +
           static_cast<std::size_t>(col);
  }

  const BinnedCells* cells_;
  SupercellOptions options_;
  std::vector<double> weights_;  ///< Of a supercell of so many cells, the small ones; by cells.
  std::vector<std::int32_t> labels_;
  CellSums supercells_;
  std::vector<double> terms_;              ///< Of each supercell: D', weighted if that is asked.
  std::vector<bool> has_variance_;         ///< Of each supercell, exactly.
  std::vector<std::uint64_t> changed_at_;  ///< Of each supercell: the number of its last move.
  CellSums blocks_;                        ///< Of this level; none where they are single cells.
  std::vector<std::uint64_t> asked_at_;    ///< Of each block of this level: after how many moves.
  ContourPull pull_;                       ///< Of this level.
  CellSums cell_;                          ///< Working memory for a block that is a single cell.
  int level_ = 0;
  int block_cols_ = 0;
  int block_rows_ = 0;
  std::uint64_t num_moves_ = 0;
  double energy_ = 0.0;
};

}  // namespace hypermap

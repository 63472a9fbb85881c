// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which blocks of 4 x 4 x 4 voted cells lie in.
#pragma once

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// Blocks are 2^kBlockShift cells wide on each axis.
inline constexpr int kBlockShift = 2;

[[nodiscard]] constexpr PointCell block_of(const PointCell& cell) {
  return {cell.x >> kBlockShift, cell.y >> kBlockShift, cell.z >> kBlockShift};
}

/// Numbers the blocks of cells from 0, in the order in which the cells name them first.
class CellBlocks {
 public:
  /// Cost: O(cells); a table of them.
  explicit CellBlocks(std::span<const PointVote> votes);

  /// The number of the block of each cell.
  [[nodiscard]] std::span<const std::uint32_t> of_cells() const noexcept { return of_cells_; }
  /// Places in the grid of blocks, by number.
  [[nodiscard]] std::span<const PointCell> blocks() const noexcept { return blocks_; }
  [[nodiscard]] std::size_t size() const noexcept { return blocks_.size(); }
  /// None for a block without cells. Cost: O(1).
  [[nodiscard]] std::optional<std::uint32_t> find(const PointCell& block) const noexcept;

 private:
  /// Where the block's number stands, or where it would.
  [[nodiscard]] std::size_t slot_of(const PointCell& block) const noexcept;

  std::vector<std::uint32_t> slots_;  ///< Open addressing, at most half full.
  std::vector<std::uint32_t> of_cells_;
  std::vector<PointCell> blocks_;
};

}  // namespace hypermap

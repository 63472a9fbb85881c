// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Votes of cells counted together in blocks.
#pragma once

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Blocks are 2^kBlockShift cells wide on each axis.
inline constexpr int kBlockShift = 2;

/// The sums of the votes of all cells in a block.
struct BlockVotes {
  std::vector<std::uint32_t> of_cell;       ///< Per cell, the sum of its block.
  std::vector<std::uint32_t> best_of_cell;  ///< Per cell, the most votes of a cell in its block.
  /// Of the block of a typical vote: half of all votes lie in blocks with more. 1 without votes.
  std::uint32_t typical = 1;
};

/// Requires: each cell once. Boundary: sums end at the largest number of 32 bits.
/// Cost: O(cells); a table of them.
[[nodiscard]] BlockVotes block_votes(std::span<const PointVote> votes);

}  // namespace hypermap

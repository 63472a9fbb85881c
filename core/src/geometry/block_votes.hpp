// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Votes of cells counted together in blocks.
#pragma once

#include "cell_blocks.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// The sums of the votes of all cells in a block.
struct BlockVotes {
  std::vector<std::uint32_t> sums;  ///< By the number of the block.
  std::vector<std::uint32_t> best;  ///< The most votes of a cell, by the number of its block.
  /// Of the block of a typical vote: half of all votes lie in blocks with more. 1 without votes.
  std::uint32_t typical = 1;
};

/// Requires: `blocks` are those of `votes`. Boundary: sums end at the largest number of 32 bits.
/// Cost: O(cells).
[[nodiscard]] BlockVotes block_votes(std::span<const PointVote> votes, const CellBlocks& blocks);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Votes of cells counted together in blocks.
#pragma once

#include "cell_blocks.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// How often the cells of each block were voted for.
struct BlockVotes {
  /// By the number of the block: the sum of its cells' votes. Of a block with more cells than the
  /// block of a typical cell has, that share of it: where faces meet, or errors lie thick, a block
  /// has more cells, not more observations.
  std::vector<std::uint32_t> sums;
  std::vector<std::uint32_t> best;  ///< The most votes of a cell, by the number of its block.
  /// The sum of the block of a typical vote: half of all sums lie in blocks with more. 1 without
  /// votes.
  std::uint32_t typical = 1;
};

/// Requires: `blocks` are those of `votes`. Boundary: sums end at the largest number of 32 bits.
/// Cost: O(cells).
[[nodiscard]] BlockVotes block_votes(std::span<const PointVote> votes, const CellBlocks& blocks);

}  // namespace hypermap

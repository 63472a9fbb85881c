// SPDX-License-Identifier: BSD-3-Clause
#include "block_votes.hpp"

#include "point_votes.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

std::uint32_t saturated_sum(std::uint32_t a, std::uint32_t b) {
  return a > std::numeric_limits<std::uint32_t>::max() - b
             ? std::numeric_limits<std::uint32_t>::max()
             : a + b;
}

}  // namespace

BlockVotes block_votes(std::span<const PointVote> votes, const CellBlocks& blocks) {
  std::vector<PointVote> summed(blocks.size());
  std::vector<std::uint32_t> best(blocks.size(), 0);
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const std::uint32_t block = blocks.of_cells()[i];
    summed[block].votes = saturated_sum(summed[block].votes, votes[i].votes);
    best[block] = std::max(best[block], votes[i].votes);
  }
  BlockVotes out{.sums = {}, .best = std::move(best), .typical = typical_votes(summed)};
  out.sums.reserve(summed.size());
  for (const PointVote& block : summed) out.sums.push_back(block.votes);
  return out;
}

}  // namespace hypermap

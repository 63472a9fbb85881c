// SPDX-License-Identifier: BSD-3-Clause
#include "block_votes.hpp"

#include "point_votes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace hypermap {
namespace {

std::uint32_t saturated_sum(std::uint32_t a, std::uint32_t b) {
  return a > std::numeric_limits<std::uint32_t>::max() - b
             ? std::numeric_limits<std::uint32_t>::max()
             : a + b;
}

/// The sum of so many cells, or where they are more than usual, of as many as usual; rounded.
std::uint32_t of_as_many(std::uint32_t sum, std::uint32_t cells, std::uint32_t usual_cells) {
  if (cells <= usual_cells) return sum;
  const std::uint64_t scaled = std::uint64_t{sum} * usual_cells + cells / 2;
  return static_cast<std::uint32_t>(scaled / cells);
}

}  // namespace

BlockVotes block_votes(std::span<const PointVote> votes, const CellBlocks& blocks) {
  std::vector<PointVote> summed(blocks.size());
  std::vector<PointVote> counted(blocks.size());
  std::vector<std::uint32_t> best(blocks.size(), 0);
  for (std::size_t i = 0; i < votes.size(); ++i) {
    const std::uint32_t block = blocks.of_cells()[i];
    summed[block].votes = saturated_sum(summed[block].votes, votes[i].votes);
    ++counted[block].votes;
    best[block] = std::max(best[block], votes[i].votes);
  }
  const std::uint32_t usual_cells = typical_votes(counted);
  BlockVotes out{.sums = {}, .best = std::move(best), .typical = 1};
  out.sums.reserve(summed.size());
  for (std::size_t i = 0; i < summed.size(); ++i) {
    summed[i].votes = of_as_many(summed[i].votes, counted[i].votes, usual_cells);
    out.sums.push_back(summed[i].votes);
  }
  out.typical = typical_votes(summed);
  return out;
}

}  // namespace hypermap

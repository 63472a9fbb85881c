// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/block_looks.hpp"

#include "cell_blocks.hpp"
#include "listed_looks.hpp"

#include <algorithm>
#include <cstddef>

namespace hypermap {

std::vector<std::uint32_t> looks_of_cells(const OccupancyVotesState& state) {
  const CellBlocks blocks(state.votes);
  const std::vector<std::uint32_t> by_block =
      looks_by_number(state.looks, blocks, state.num_observations);
  std::vector<std::uint32_t> by_cell;
  by_cell.reserve(state.votes.size());
  for (const std::uint32_t block : blocks.of_cells()) by_cell.push_back(by_block[block]);
  return by_cell;
}

std::vector<PointVote> looks_of_blocks(std::span<const PointVote> votes,
                                       std::span<const std::uint32_t> looks_of_cells,
                                       std::uint32_t num_observations) {
  const CellBlocks blocks(votes);
  std::vector<std::uint32_t> by_block(blocks.size(), 0);
  for (std::size_t i = 0; i < votes.size(); ++i) {
    std::uint32_t& looks = by_block[blocks.of_cells()[i]];
    looks = std::max(looks, looks_of_cells[i]);
  }
  return listed_looks(by_block, blocks, num_observations);
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Looks at blocks of voted cells: by the number of the block, and as a state lists them.
#pragma once

#include "cell_blocks.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Of each block by its number: what the list says, or `unlisted`.
/// Boundary: blocks of the list without cells are left out.
[[nodiscard]] std::vector<std::uint32_t> looks_by_number(std::span<const PointVote> listed,
                                                         const CellBlocks& blocks,
                                                         std::uint32_t unlisted);

/// The list, ascending, of blocks with fewer looks than there were observations.
[[nodiscard]] std::vector<PointVote> listed_looks(std::span<const std::uint32_t> by_number,
                                                  const CellBlocks& blocks,
                                                  std::uint32_t num_observations);

/// The list with cells of twice the edge: a wide block was in view as often as the one of its parts
/// that was most.
[[nodiscard]] std::vector<PointVote> widened_looks(const OccupancyVotesState& state);

/// What two say of the blocks of `votes`, the cells of both: where one has no cell, its
/// observations looked in vain.
[[nodiscard]] std::vector<PointVote> sum_of_looks(const OccupancyVotesState& a,
                                                  const OccupancyVotesState& b,
                                                  std::span<const PointVote> votes);

/// The list as if all blocks were in view of a further observation.
[[nodiscard]] std::vector<PointVote> with_look_at_all(std::vector<PointVote> looks);

/// The list after the newest observation, which `state` counts already as if it had all blocks in
/// view. `blocks` are those of the state, `observed` the observation's cells: a block with one of
/// them was in view, another one when `is_in_view` says so of its centre. A block that only this
/// observation has cells of was in view of it, and of `num_looks_from_there` before it: nobody
/// knows of a place where nothing was.
[[nodiscard]] std::vector<PointVote> looks_after(const OccupancyVotesState& state,
                                                 const CellBlocks& blocks,
                                                 std::span<const PointVote> observed,
                                                 const IsInView& is_in_view,
                                                 std::uint32_t num_looks_from_there);

}  // namespace hypermap

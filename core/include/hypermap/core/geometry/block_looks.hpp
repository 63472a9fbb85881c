// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How many observations of an object had a block of its cells in view, as `OccupancyVotesState`
/// keeps it, for those who make states anew. Ours.
#pragma once

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// By the cells of the state, how many observations had the cell's block in view.
/// Cost: O(cells).
[[nodiscard]] std::vector<std::uint32_t> looks_of_cells(const OccupancyVotesState& state);

/// What `OccupancyVotesState::looks` says of blocks whose cells were in view so often: a block as
/// often as the one of its cells that was most. Those that all observations had are left out.
/// Requires: a number for each vote. Cost: O(cells + listed blocks log).
[[nodiscard]] std::vector<PointVote> looks_of_blocks(std::span<const PointVote> votes,
                                                     std::span<const std::uint32_t> looks_of_cells,
                                                     std::uint32_t num_observations);

}  // namespace hypermap

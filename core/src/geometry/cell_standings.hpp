// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which of an object's voted cells count.
#pragma once

#include "cell_blocks.hpp"
#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// The share asked for of what is usual.
[[nodiscard]] std::uint32_t votes_needed(const OccupancyVotesState& state,
                                         std::uint32_t usual,
                                         const OccupancyVotesOptions& options);

/// Of each cell of the state, whose blocks these are. `typical`: typical_votes of its cells.
///
/// A cell needs its share of what a typical cell has, or the best one of its block where that has
/// less: the legs of a table are seen more rarely than its top, and are no error for that. Its
/// block needs a share of what a typical block has. Where a cell of the block has three votes, and
/// min_vote_share of the observations that had the block in view, it needs what a typical block has
/// from so many observations.
/// Cost: O(cells).
[[nodiscard]] std::vector<CellStanding> standings_of(const OccupancyVotesState& state,
                                                     const CellBlocks& blocks,
                                                     std::uint32_t typical,
                                                     const OccupancyVotesOptions& options);

/// Numbers and bounds of the agreed cells, which `standings` names; the rest is that of
/// `thresholds`.
[[nodiscard]] CellAgreement agreement_of(const OccupancyVotesState& state,
                                         std::span<const CellStanding> standings,
                                         const CellAgreement& thresholds);

}  // namespace hypermap

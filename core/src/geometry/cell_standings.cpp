// SPDX-License-Identifier: BSD-3-Clause
#include "cell_standings.hpp"

#include "block_votes.hpp"
#include "listed_looks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

/// From so many observations on, a cell that only one of them saw is a stray.
constexpr std::uint32_t kNumToOutvoteOne = 4;
/// So many observations agree on a cell of a block that few looked at, or it is a stray.
constexpr std::uint32_t kNumToSpeakForBlock = 3;

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

/// By the number of the block, whether too few segments have points in it.
std::vector<bool> stray_blocks(const OccupancyVotesState& state,
                               const CellBlocks& blocks,
                               const BlockVotes& votes,
                               const OccupancyVotesOptions& options) {
  const auto looks = looks_by_number(state.looks, blocks, state.num_observations);
  const double needed = options.min_block_share * votes.typical;
  std::vector<bool> is_stray(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double looked_share = static_cast<double>(looks[i]) / state.num_observations;
    const bool is_agreed_on =
        votes.best[i] >= kNumToSpeakForBlock && votes.best[i] >= options.min_vote_share * looks[i];
    const bool is_seldom_seen = is_agreed_on && votes.sums[i] >= looked_share * needed;
    is_stray[i] = votes.sums[i] < needed && !is_seldom_seen;
  }
  return is_stray;
}

}  // namespace

std::uint32_t votes_needed(const OccupancyVotesState& state,
                           std::uint32_t usual,
                           const OccupancyVotesOptions& options) {
  const double needed = std::ceil(options.min_vote_share * usual);
  const std::uint32_t least =
      options.min_vote_share > 0.0 && state.num_observations >= kNumToOutvoteOne ? 2U : 1U;
  return std::max(least, static_cast<std::uint32_t>(needed));
}

std::vector<CellStanding> standings_of(const OccupancyVotesState& state,
                                       const CellBlocks& blocks,
                                       std::uint32_t typical,
                                       const OccupancyVotesOptions& options) {
  std::vector<CellStanding> out;
  out.reserve(state.votes.size());
  const auto standing = [&](const PointVote& vote, std::uint32_t usual) {
    return vote.votes >= votes_needed(state, usual, options) ? CellStanding::kAgreed
                                                             : CellStanding::kSupported;
  };
  if (options.min_block_share == 0.0) {
    for (const PointVote& vote : state.votes) out.push_back(standing(vote, typical));
    return out;
  }
  const BlockVotes in_blocks = block_votes(state.votes, blocks);
  const std::vector<bool> is_stray = stray_blocks(state, blocks, in_blocks, options);
  for (std::size_t i = 0; i < state.votes.size(); ++i) {
    const std::uint32_t block = blocks.of_cells()[i];
    const std::uint32_t usual = std::min(typical, in_blocks.best[block]);
    out.push_back(is_stray[block] ? CellStanding::kStray : standing(state.votes[i], usual));
  }
  return out;
}

CellAgreement agreement_of(const OccupancyVotesState& state,
                           std::span<const CellStanding> standings,
                           const CellAgreement& thresholds) {
  CellAgreement out = thresholds;
  PointCell low{kHighest, kHighest, kHighest};
  PointCell high{kLowest, kLowest, kLowest};
  for (std::size_t i = 0; i < standings.size(); ++i) {
    const PointCell& cell = state.votes[i].cell;
    const bool counts = standings[i] == CellStanding::kAgreed;
    out.num_cells += counts ? 1U : 0U;
    low.x = std::min(low.x, counts ? cell.x : kHighest);
    low.y = std::min(low.y, counts ? cell.y : kHighest);
    low.z = std::min(low.z, counts ? cell.z : kHighest);
    high.x = std::max(high.x, counts ? cell.x : kLowest);
    high.y = std::max(high.y, counts ? cell.y : kLowest);
    high.z = std::max(high.z, counts ? cell.z : kLowest);
  }
  if (out.num_cells == 0) return out;
  out.low = low;
  out.high = high;
  return out;
}

}  // namespace hypermap

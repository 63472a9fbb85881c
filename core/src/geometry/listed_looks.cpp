// SPDX-License-Identifier: BSD-3-Clause
#include "listed_looks.hpp"

#include "point_votes.hpp"

#include <algorithm>
#include <cstddef>

namespace hypermap {
namespace {

/// What the newest observation says of a block.
struct SeenBlock {
  bool has_cell = false;  ///< It has a cell there.
  bool is_first = true;   ///< Nothing but its cells is there, and nobody else voted for them.
};

std::vector<SeenBlock> seen_blocks(std::span<const PointVote> votes,
                                   std::span<const PointVote> observed,
                                   const CellBlocks& blocks) {
  std::vector<SeenBlock> seen(blocks.size());
  auto next = observed.begin();
  for (std::size_t i = 0; i < votes.size(); ++i) {
    while (next != observed.end() && next->cell < votes[i].cell) ++next;
    const bool is_observed = next != observed.end() && next->cell == votes[i].cell;
    SeenBlock& block = seen[blocks.of_cells()[i]];
    block.has_cell = block.has_cell || is_observed;
    block.is_first = block.is_first && is_observed && votes[i].votes == 1;
  }
  return seen;
}

}  // namespace

std::vector<std::uint32_t> looks_by_number(std::span<const PointVote> listed,
                                           const CellBlocks& blocks,
                                           std::uint32_t unlisted) {
  std::vector<std::uint32_t> by_number(blocks.size(), unlisted);
  for (const PointVote& one : listed) {
    if (const auto number = blocks.find(one.cell)) by_number[*number] = one.votes;
  }
  return by_number;
}

std::vector<PointVote> listed_looks(std::span<const std::uint32_t> by_number,
                                    const CellBlocks& blocks,
                                    std::uint32_t num_observations) {
  std::vector<PointVote> listed;
  for (std::size_t i = 0; i < by_number.size(); ++i) {
    if (by_number[i] < num_observations) listed.push_back({blocks.blocks()[i], by_number[i]});
  }
  std::sort(listed.begin(), listed.end());
  return listed;
}

std::vector<PointVote> widened_looks(const OccupancyVotesState& state) {
  if (state.looks.empty()) return {};
  const CellBlocks blocks(state.votes);
  const auto looks = looks_by_number(state.looks, blocks, state.num_observations);
  std::vector<PointVote> all;
  all.reserve(blocks.size());
  for (std::size_t i = 0; i < blocks.size(); ++i) all.push_back({blocks.blocks()[i], looks[i]});
  all = widened(all);
  std::erase_if(all, [&](const PointVote& one) { return one.votes == state.num_observations; });
  return all;
}

std::vector<PointVote> sum_of_looks(const OccupancyVotesState& a,
                                    const OccupancyVotesState& b,
                                    std::span<const PointVote> votes) {
  if (a.looks.empty() && b.looks.empty()) return {};
  const CellBlocks blocks(votes);
  auto looks = looks_by_number(a.looks, blocks, a.num_observations);
  const auto of_b = looks_by_number(b.looks, blocks, b.num_observations);
  for (std::size_t i = 0; i < looks.size(); ++i) looks[i] += of_b[i];
  return listed_looks(looks, blocks, a.num_observations + b.num_observations);
}

std::vector<PointVote> with_look_at_all(std::vector<PointVote> looks) {
  for (PointVote& block : looks) ++block.votes;
  return looks;
}

std::vector<PointVote> looks_after(const OccupancyVotesState& state,
                                   const CellBlocks& blocks,
                                   std::span<const PointVote> observed,
                                   const IsInView& is_in_view,
                                   std::uint32_t num_looks_from_there) {
  const auto seen = seen_blocks(state.votes, observed, blocks);
  const double edge_m = static_cast<double>(1 << kBlockShift) * state.edge_m;
  std::vector<std::uint32_t> looks = looks_by_number(state.looks, blocks, state.num_observations);
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const bool was_seen = seen[i].has_cell || is_in_view(centre_of(blocks.blocks()[i], edge_m));
    std::uint32_t before = looks[i] - 1;
    if (seen[i].is_first) before = std::min(before, num_looks_from_there);
    looks[i] = before + (was_seen ? 1 : 0);
  }
  return listed_looks(looks, blocks, state.num_observations);
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/occupancy_votes.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "point_votes.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

/// From so many observations on, a cell that only one of them saw is a stray.
constexpr std::uint32_t kNumToOutvoteOne = 4;

void widen(OccupancyVotesState& state) {
  state.votes = widened(state.votes);
  state.edge_m *= 2.0;
}

/// Of the cell of a typical vote: half of all votes lie in cells with more. Strays are many cells
/// but few votes.
std::uint32_t typical_votes_of(const OccupancyVotesState& state) {
  std::uint64_t total = 0;
  std::uint32_t most = 0;
  for (const PointVote& vote : state.votes) {
    total += vote.votes;
    most = std::max(most, vote.votes);
  }
  return total == 0 ? 1 : typical_votes(state.votes, most, total);
}

/// The share asked for of what the cell of a typical vote has.
std::uint32_t votes_needed(const OccupancyVotesState& state,
                           std::uint32_t typical,
                           const OccupancyVotesOptions& options) {
  const double needed = std::ceil(options.min_vote_share * typical);
  const std::uint32_t least =
      options.min_vote_share > 0.0 && state.num_observations >= kNumToOutvoteOne ? 2U : 1U;
  return std::max(least, static_cast<std::uint32_t>(needed));
}

/// Forgets the cells that fewest agree on, or, when too many are agreed on, doubles their edges.
void make_room(OccupancyVotesState& state, const OccupancyVotesOptions& options) {
  while (state.votes.size() > options.max_cells) {
    const std::uint32_t needed = votes_needed(state, typical_votes_of(state), options);
    const auto num_agreed = static_cast<std::size_t>(
        std::count_if(state.votes.begin(), state.votes.end(), [&](const PointVote& v) {
          return v.votes >= needed;
        }));
    const std::size_t most = options.max_cells;
    if (num_agreed > most / 4 * 3) {
      widen(state);
      continue;
    }
    std::stable_sort(state.votes.begin(), state.votes.end(), [](const auto& a, const auto& b) {
      return a.votes > b.votes;
    });
    state.votes.resize(options.max_cells);
    std::sort(state.votes.begin(), state.votes.end());
  }
}

/// Lowest and highest cell on each axis. Requires: not empty.
struct CellBounds {
  PointCell low;
  PointCell high;

  [[nodiscard]] bool contains(const PointCell& cell) const {
    return low.x <= cell.x && cell.x <= high.x && low.y <= cell.y && cell.y <= high.y &&
           low.z <= cell.z && cell.z <= high.z;
  }
};

CellBounds bounds_of(std::span<const PointVote> votes) {
  CellBounds bounds{votes.front().cell, votes.front().cell};
  for (const auto& [cell, count] : votes) {
    bounds.low = {std::min(bounds.low.x, cell.x),
                  std::min(bounds.low.y, cell.y),
                  std::min(bounds.low.z, cell.z)};
    bounds.high = {std::max(bounds.high.x, cell.x),
                   std::max(bounds.high.y, cell.y),
                   std::max(bounds.high.z, cell.z)};
  }
  return bounds;
}

/// How often the edge `fine_m` doubles up to `coarse_m`.
int num_doublings(double fine_m, double coarse_m) {
  int count = 0;
  for (double edge_m = fine_m; edge_m < coarse_m; edge_m *= 2.0) ++count;
  return count;
}

/// For each cell of `finer` the position of the cell of `coarser` around it, where there is one.
template <class Visit>
void for_each_common_cell(const OccupancyVotesState& finer,
                          const OccupancyVotesState& coarser,
                          Visit visit) {
  const int shift = num_doublings(finer.edge_m, coarser.edge_m);
  const CellBounds bounds = bounds_of(coarser.votes);
  for (std::size_t i = 0; i < finer.votes.size(); ++i) {
    const PointCell& cell = finer.votes[i].cell;
    const PointCell around{cell.x >> shift, cell.y >> shift, cell.z >> shift};
    if (!bounds.contains(around)) continue;
    const auto found = std::lower_bound(
        coarser.votes.begin(),
        coarser.votes.end(),
        around,
        [](const PointVote& vote, const PointCell& wanted) { return vote.cell < wanted; });
    if (found == coarser.votes.end() || found->cell != around) continue;
    visit(i, static_cast<std::size_t>(found - coarser.votes.begin()));
  }
}

/// Per cell of `mine` the votes of the cell of `other` there, the best of finer ones; 0 for none.
std::vector<std::uint32_t> votes_at(const OccupancyVotesState& mine,
                                    const OccupancyVotesState& other) {
  std::vector<std::uint32_t> found(mine.votes.size(), 0);
  if (other.edge_m < mine.edge_m) {
    for_each_common_cell(other, mine, [&](std::size_t theirs, std::size_t ours) {
      found[ours] = std::max(found[ours], other.votes[theirs].votes);
    });
  } else {
    for_each_common_cell(mine, other, [&](std::size_t ours, std::size_t theirs) {
      found[ours] = other.votes[theirs].votes;
    });
  }
  return found;
}

Result<void> check_edge(double edge_m, double first_edge_m) {
  double edge = first_edge_m;
  while (edge < edge_m) edge *= 2.0;
  if (edge == edge_m) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be " + number_text(first_edge_m) + " doubled, is " + number_text(edge_m),
              "points.edge_m");
}

}  // namespace

OccupancyVotes::OccupancyVotes(const OccupancyVotesOptions& options) : options_(options) {
  take({.edge_m = options.edge_m, .num_observations = 0, .votes = {}});
}

Result<OccupancyVotes> OccupancyVotes::from_state(const OccupancyVotesOptions& options,
                                                  OccupancyVotesState state) {
  HYPERMAP_TRY(validate(options));
  if (!(state.edge_m <= kMaxVotedCoordinateM)) {
    return fail(ErrorCode::kInvalidArgument, "is too large or no number", "points.edge_m");
  }
  HYPERMAP_TRY(check_edge(state.edge_m, options.edge_m));
  if (state.votes.size() > options.max_cells) {
    return fail(ErrorCode::kInvalidArgument,
                "must be at most " + std::to_string(options.max_cells) + ", are " +
                    std::to_string(state.votes.size()),
                "points.votes");
  }
  for (std::size_t i = 0; i < state.votes.size(); ++i) {
    const PointVote& vote = state.votes[i];
    const bool ascends = i == 0 || state.votes[i - 1].cell < vote.cell;
    if (ascends && vote.votes > 0 && vote.votes <= state.num_observations) continue;
    return fail(ErrorCode::kInvalidArgument,
                "cells must ascend, votes be in 1..num_observations",
                "points.votes[" + std::to_string(i) + "]");
  }
  OccupancyVotes evidence(options);
  evidence.typical_votes_ = typical_votes_of(state);
  evidence.votes_needed_ = votes_needed(state, evidence.typical_votes_, options);
  evidence.state_ = std::make_shared<const OccupancyVotesState>(std::move(state));
  return evidence;
}

void OccupancyVotes::observe(std::span<const Eigen::Vector3f> points_in_map) {
  take({.edge_m = state_->edge_m,
        .num_observations = state_->num_observations + 1,
        .votes = sum_of(state_->votes, votes_of(points_in_map, state_->edge_m))});
}

void OccupancyVotes::merge(const OccupancyVotes& other) {
  assert(options_ == other.options_);
  OccupancyVotesState mine = *state_;
  OccupancyVotesState added = *other.state_;
  while (added.edge_m < mine.edge_m) widen(added);
  while (mine.edge_m < added.edge_m) widen(mine);
  mine.num_observations += added.num_observations;
  mine.votes = sum_of(mine.votes, added.votes);
  take(std::move(mine));
}

void OccupancyVotes::take(OccupancyVotesState state) {
  make_room(state, options_);
  const std::uint32_t typical = typical_votes_of(state);
  const std::uint32_t needed = votes_needed(state, typical, options_);
  state_ = std::make_shared<const OccupancyVotesState>(std::move(state));
  typical_votes_ = typical;
  votes_needed_ = needed;
}

std::size_t OccupancyVotes::yield_to(const OccupancyVotes& other, double factor) {
  if (empty() || other.empty()) return 0;
  const std::vector<std::uint32_t> theirs = votes_at(*state_, *other.state_);
  const auto is_kept = [&](std::size_t i) {
    const double their_share = static_cast<double>(theirs[i]) / other.typical_votes_;
    return their_share < factor * state_->votes[i].votes / typical_votes_;
  };
  std::size_t num_kept = 0;
  for (std::size_t i = 0; i < theirs.size(); ++i) num_kept += is_kept(i) ? 1U : 0U;
  if (num_kept == 0 || num_kept == theirs.size()) return 0;
  OccupancyVotesState kept{
      .edge_m = state_->edge_m, .num_observations = state_->num_observations, .votes = {}};
  kept.votes.reserve(num_kept);
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    if (is_kept(i)) kept.votes.push_back(state_->votes[i]);
  }
  take(std::move(kept));
  return theirs.size() - num_kept;
}

std::vector<Eigen::Vector3d> OccupancyVotes::agreed_points() const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(state_->votes.size());
  for (const PointVote& vote : state_->votes) {
    if (vote.votes >= votes_needed_) points.push_back(centre_of(vote.cell, state_->edge_m));
  }
  return points;
}

std::optional<Box> OccupancyVotes::agreed_box() const {
  const std::vector<Eigen::Vector3d> points = agreed_points();
  if (points.empty()) return std::nullopt;
  Box box{points.front(), points.front()};
  for (const Eigen::Vector3d& p : points) {
    box.min_in_map = box.min_in_map.cwiseMin(p);
    box.max_in_map = box.max_in_map.cwiseMax(p);
  }
  box.min_in_map.array() -= 0.25 * state_->edge_m;
  box.max_in_map.array() += 0.25 * state_->edge_m;
  return box;
}

Result<Polygon> OccupancyVotes::footprint() const {
  if (empty()) return fail(ErrorCode::kNotFound, "the object has no points of its own");
  const double reach = 0.25 * state_->edge_m;
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector3d& p : agreed_points()) {
    for (const double dx : {-reach, reach}) {
      for (const double dy : {-reach, reach}) corners.emplace_back(p.x() + dx, p.y() + dy);
    }
  }
  return convex_hull(corners);
}

}  // namespace hypermap

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

/// The share asked for of what the cell of a typical vote has: half of all votes lie in cells with
/// more. Strays are many cells but few votes.
std::uint32_t votes_needed(const OccupancyVotesState& state, const OccupancyVotesOptions& options) {
  std::uint64_t total = 0;
  std::uint32_t most = 0;
  for (const PointVote& vote : state.votes) {
    total += vote.votes;
    most = std::max(most, vote.votes);
  }
  const std::uint32_t typical = total == 0 ? 1 : typical_votes(state.votes, most, total);
  const double needed = std::ceil(options.min_vote_share * typical);
  const std::uint32_t least =
      options.min_vote_share > 0.0 && state.num_observations >= kNumToOutvoteOne ? 2U : 1U;
  return std::max(least, static_cast<std::uint32_t>(needed));
}

/// Forgets the cells that fewest agree on, or, when too many are agreed on, doubles their edges.
void make_room(OccupancyVotesState& state, const OccupancyVotesOptions& options) {
  while (state.votes.size() > options.max_cells) {
    const std::uint32_t needed = votes_needed(state, options);
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
  evidence.votes_needed_ = votes_needed(state, options);
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
  const std::uint32_t needed = votes_needed(state, options_);
  state_ = std::make_shared<const OccupancyVotesState>(std::move(state));
  votes_needed_ = needed;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/occupancy_votes.hpp"

#include "cell_standings.hpp"
#include "common_cells.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "listed_looks.hpp"
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

void widen(OccupancyVotesState& state) {
  state.looks = widened_looks(state);
  state.votes = widened(state.votes);
  state.edge_m *= 2.0;
}

/// Doubles the edges of the cells until there is room. Forgetting those of few votes instead would
/// keep out what was seen last: of a large thing most cells have one vote.
void make_room(OccupancyVotesState& state, const OccupancyVotesOptions& options) {
  while (state.votes.size() > options.max_cells) widen(state);
}

/// How often the edge `fine_m` doubles up to `coarse_m`.
int num_doublings(double fine_m, double coarse_m) {
  int count = 0;
  for (double edge_m = fine_m; edge_m < coarse_m; edge_m *= 2.0) ++count;
  return count;
}

/// Whether a cell with so many of its object's votes goes to one with more of another object's.
class Contest {
 public:
  Contest(std::uint32_t my_typical, std::uint32_t their_typical, double factor)
      : my_typical_(my_typical), their_typical_(their_typical), factor_(factor) {}
  [[nodiscard]] bool is_lost(const PointVote& mine, const PointVote& theirs) const {
    const double their_share = static_cast<double>(theirs.votes) / their_typical_;
    return !(their_share < factor_ * mine.votes / my_typical_);
  }

 private:
  std::uint32_t my_typical_;
  std::uint32_t their_typical_;
  double factor_;
};

/// Positions of the cells of `mine` that `other` agrees on more, ascending, each once.
std::vector<std::size_t> lost_cells(const OccupancyVotesState& mine,
                                    const OccupancyVotesState& other,
                                    const Contest& contest) {
  std::vector<std::size_t> lost;
  const auto compare = [&](std::size_t ours, std::size_t theirs) {
    if (contest.is_lost(mine.votes[ours], other.votes[theirs])) lost.push_back(ours);
  };
  if (other.edge_m < mine.edge_m) {
    for_each_common_cell(other.votes,
                         mine.votes,
                         num_doublings(other.edge_m, mine.edge_m),
                         [&](std::size_t theirs, std::size_t ours) { compare(ours, theirs); });
    // A cell stands there once for each of its finer ones that is agreed on more.
    std::sort(lost.begin(), lost.end());
    lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
  } else {
    for_each_common_cell(
        mine.votes, other.votes, num_doublings(mine.edge_m, other.edge_m), compare);
  }
  return lost;
}

/// The votes without those at the positions. Requires: ascending, each once.
std::vector<PointVote> without(std::span<const PointVote> votes,
                               std::span<const std::size_t> positions) {
  std::vector<PointVote> kept;
  kept.reserve(votes.size() - positions.size());
  std::size_t next = 0;
  const auto keep_up_to = [&](std::size_t end) {
    const auto part = votes.subspan(next, end - next);
    kept.insert(kept.end(), part.begin(), part.end());
    next = end + 1;
  };
  for (const std::size_t position : positions) keep_up_to(position);
  keep_up_to(votes.size());
  return kept;
}

Result<void> check_edge(double edge_m, double first_edge_m) {
  double edge = first_edge_m;
  while (edge < edge_m) edge *= 2.0;
  if (edge == edge_m) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be " + number_text(first_edge_m) + " doubled, is " + number_text(edge_m),
              "points.edge_m");
}

/// Errors: kInvalidArgument: more entries than `max_entries`, not ascending, or numbers that are
/// not within 1 and `most`, naming the list or the entry.
Result<void> check_ascending(std::span<const PointVote> list,
                             std::size_t max_entries,
                             std::uint32_t most,
                             const std::string& field,
                             const char* rule) {
  if (list.size() > max_entries) {
    return fail(
        ErrorCode::kInvalidArgument,
        "must be at most " + std::to_string(max_entries) + ", are " + std::to_string(list.size()),
        field);
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const bool ascends = i == 0 || list[i - 1].cell < list[i].cell;
    if (ascends && list[i].votes > 0 && list[i].votes <= most) continue;
    return fail(ErrorCode::kInvalidArgument, rule, field + "[" + std::to_string(i) + "]");
  }
  return {};
}

/// Of points in the order of their cells the first and the last in the plan of each x: those
/// between lie on no hull.
std::vector<Eigen::Vector2d> row_ends(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Eigen::Vector2d> ends;
  for (std::size_t first = 0, next = 0; first < points.size(); first = next) {
    while (next < points.size() && points[next].x() == points[first].x()) ++next;
    ends.emplace_back(points[first].head<2>());
    if (points[next - 1].y() != points[first].y()) ends.emplace_back(points[next - 1].head<2>());
  }
  return ends;
}

}  // namespace

OccupancyVotes::OccupancyVotes(const OccupancyVotesOptions& options) : options_(options) {
  take({.edge_m = options.edge_m, .num_observations = 0, .votes = {}, .looks = {}});
}

Result<OccupancyVotes> OccupancyVotes::from_state(const OccupancyVotesOptions& options,
                                                  OccupancyVotesState state) {
  HYPERMAP_TRY(validate(options));
  if (!(state.edge_m <= kMaxVotedCoordinateM)) {
    return fail(ErrorCode::kInvalidArgument, "is too large or no number", "points.edge_m");
  }
  HYPERMAP_TRY(check_edge(state.edge_m, options.edge_m));
  HYPERMAP_TRY(check_ascending(state.votes,
                               options.max_cells,
                               state.num_observations,
                               "points.votes",
                               "cells must ascend, votes be in 1..num_observations"));
  const std::uint32_t most_looks = state.num_observations - std::min(state.num_observations, 1U);
  HYPERMAP_TRY(check_ascending(state.looks,
                               options.max_cells,
                               most_looks,
                               "points.looks",
                               "blocks must ascend, looks be in 1..num_observations - 1"));
  OccupancyVotes evidence(options);
  evidence.adopt(std::move(state));
  return evidence;
}

void OccupancyVotes::observe(std::span<const Eigen::Vector3f> points_in_map) {
  take({.edge_m = state_->edge_m,
        .num_observations = state_->num_observations + 1,
        .votes = sum_of(state_->votes, votes_of(points_in_map, state_->edge_m)),
        .looks = with_look_at_all(state_->looks)});
}

void OccupancyVotes::look(std::span<const Eigen::Vector3f> points_in_map,
                          const IsInView& is_in_view,
                          std::uint32_t num_looks_from_there) {
  assert(state_->num_observations > 0);
  const CellBlocks blocks(state_->votes);
  const auto observed = votes_of(points_in_map, state_->edge_m);
  auto looks = looks_after(*state_, blocks, observed, is_in_view, num_looks_from_there);
  if (looks == state_->looks) return;
  OccupancyVotesState state = *state_;
  state.looks = std::move(looks);
  adopt(std::move(state), blocks);
}

void OccupancyVotes::merge(const OccupancyVotes& other) {
  assert(options_ == other.options_);
  OccupancyVotesState mine = *state_;
  OccupancyVotesState added = *other.state_;
  while (added.edge_m < mine.edge_m) widen(added);
  while (mine.edge_m < added.edge_m) widen(mine);
  const std::vector<PointVote> votes = sum_of(mine.votes, added.votes);
  take({.edge_m = mine.edge_m,
        .num_observations = mine.num_observations + added.num_observations,
        .votes = votes,
        .looks = sum_of_looks(mine, added, votes)});
}

void OccupancyVotes::take(OccupancyVotesState state) {
  make_room(state, options_);
  adopt(std::move(state));
}

void OccupancyVotes::adopt(OccupancyVotesState state) {
  const CellBlocks blocks(state.votes);
  adopt(std::move(state), blocks);
}

void OccupancyVotes::adopt(OccupancyVotesState state, const CellBlocks& blocks) {
  CellAgreement thresholds;
  thresholds.typical_votes = typical_votes(state.votes);
  thresholds.votes_needed = votes_needed(state, thresholds.typical_votes, options_);
  auto standings = std::make_shared<const std::vector<CellStanding>>(
      standings_of(state, blocks, thresholds.typical_votes, options_));
  const CellAgreement agreement = agreement_of(state, *standings, thresholds);
  state_ = std::make_shared<const OccupancyVotesState>(std::move(state));
  standings_ = std::move(standings);
  agreement_ = agreement;
}

std::size_t OccupancyVotes::yield_to(const OccupancyVotes& other,
                                     double factor,
                                     ContestedPlace place) {
  const Contest contest(agreement_.typical_votes, other.agreement_.typical_votes, factor);
  OccupancyVotesState wide;
  if (place == ContestedPlace::kBlock) {
    wide = *other.state_;
    for (int i = 0; i < kBlockShift; ++i) widen(wide);
  }
  const OccupancyVotesState& theirs = place == ContestedPlace::kBlock ? wide : *other.state_;
  const auto lost = lost_cells(*state_, theirs, contest);
  if (lost.empty() || lost.size() == state_->votes.size()) return 0;
  take({.edge_m = state_->edge_m,
        .num_observations = state_->num_observations,
        .votes = without(state_->votes, lost),
        .looks = state_->looks});
  return lost.size();
}

void OccupancyVotes::deny(std::span<const std::size_t> positions) {
  if (positions.empty()) return;
  OccupancyVotesState state = *state_;
  for (const std::size_t position : positions) --state.votes[position].votes;
  std::erase_if(state.votes, [](const PointVote& vote) { return vote.votes == 0; });
  if (!state.votes.empty()) adopt(std::move(state));
}

std::vector<Eigen::Vector3d> OccupancyVotes::points_from(CellStanding least) const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(least == CellStanding::kAgreed ? agreement_.num_cells : state_->votes.size());
  for (std::size_t i = 0; i < state_->votes.size(); ++i) {
    if ((*standings_)[i] >= least)
      points.push_back(centre_of(state_->votes[i].cell, state_->edge_m));
  }
  return points;
}

std::vector<Eigen::Vector3d> OccupancyVotes::agreed_points() const {
  return points_from(CellStanding::kAgreed);
}

std::vector<Eigen::Vector3d> OccupancyVotes::supported_points() const {
  return points_from(CellStanding::kSupported);
}

std::optional<Box> OccupancyVotes::agreed_box() const {
  if (agreement_.num_cells == 0) return std::nullopt;
  // The centre of a cell grows with its coordinates, so that the lowest cell's is the lowest.
  Box box{centre_of(agreement_.low, state_->edge_m), centre_of(agreement_.high, state_->edge_m)};
  box.min_in_map.array() -= 0.25 * state_->edge_m;
  box.max_in_map.array() += 0.25 * state_->edge_m;
  return box;
}

Result<Polygon> OccupancyVotes::footprint() const {
  if (empty()) return fail(ErrorCode::kNotFound, "the object has no points of its own");
  const double reach = 0.25 * state_->edge_m;
  std::vector<Eigen::Vector2d> corners;
  for (const Eigen::Vector2d& p : row_ends(agreed_points())) {
    for (const double dx : {-reach, reach}) {
      for (const double dy : {-reach, reach}) corners.emplace_back(p.x() + dx, p.y() + dy);
    }
  }
  return convex_hull(corners);
}

}  // namespace hypermap

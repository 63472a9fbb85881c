// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/footprint.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <boost/sort/pdqsort/pdqsort.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

constexpr double kMaxCoordinateM = 1e6;
/// From so many observations on, a cell that only one of them saw is a stray.
constexpr std::uint32_t kNumToOutvoteOne = 4;

/// The cell of twice the edge that a cell lies in; rounds towards minus infinity.
PointCell widened(const PointCell& cell) {
  const auto half = [](std::int32_t i) { return (i - (i & 1)) / 2; };
  return {half(cell.x), half(cell.y), half(cell.z)};
}

/// A wide cell has the votes of the best of its parts: their sum would count an observation several
/// times, and strays that lie side by side would agree.
std::vector<PointVote> widened(std::span<const PointVote> votes) {
  std::vector<PointVote> out;
  out.reserve(votes.size());
  for (const PointVote& vote : votes) out.push_back({widened(vote.cell), vote.votes});
  std::sort(out.begin(), out.end());  // of equal cells the one with most votes comes last
  std::size_t kept = 0;
  for (const PointVote& vote : out) {
    if (kept > 0 && out[kept - 1].cell == vote.cell) --kept;
    out[kept++] = vote;
  }
  out.resize(kept);
  return out;
}

/// The cells of one thing lie close together: each becomes one number, of the same order. None when
/// they do not.
class PackedCells {
 public:
  [[nodiscard]] static std::optional<PackedCells> around(std::span<const PointCell> cells) {
    PackedCells packed(cells.front());
    PointCell high = cells.front();
    for (const PointCell& cell : cells) {
      packed.low_ = {std::min(packed.low_.x, cell.x),
                     std::min(packed.low_.y, cell.y),
                     std::min(packed.low_.z, cell.z)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y), std::max(high.z, cell.z)};
    }
    const auto fits = [](std::int32_t from, std::int32_t to) {
      return std::int64_t{to} - from < std::int64_t{1} << kBits;
    };
    const bool all_fit =
        fits(packed.low_.x, high.x) && fits(packed.low_.y, high.y) && fits(packed.low_.z, high.z);
    return all_fit ? std::optional(packed) : std::nullopt;
  }
  [[nodiscard]] std::uint64_t pack(const PointCell& cell) const {
    const auto part = [](std::int32_t from, std::int32_t at) {
      return static_cast<std::uint64_t>(at - from);
    };
    return part(low_.x, cell.x) << 2 * kBits | part(low_.y, cell.y) << kBits | part(low_.z, cell.z);
  }
  [[nodiscard]] PointCell unpack(std::uint64_t number) const {
    const auto part = [](std::uint64_t shifted) {
      return static_cast<std::int32_t>(shifted & ((std::uint64_t{1} << kBits) - 1));
    };
    return {
        low_.x + part(number >> 2 * kBits), low_.y + part(number >> kBits), low_.z + part(number)};
  }

 private:
  static constexpr unsigned kBits = 21;
  explicit PackedCells(const PointCell& low) : low_(low) {}
  PointCell low_;
};

/// Ascending, each once.
void sort_unique(std::vector<PointCell>& cells) {
  if (cells.empty()) return;
  const auto packed = PackedCells::around(cells);
  if (!packed) {
    std::sort(cells.begin(), cells.end());
    cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
    return;
  }
  std::vector<std::uint64_t> numbers;
  numbers.reserve(cells.size());
  for (const PointCell& cell : cells) numbers.push_back(packed->pack(cell));
  boost::sort::pdqsort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  cells.clear();
  for (const std::uint64_t number : numbers) cells.push_back(packed->unpack(number));
}

std::vector<PointVote> votes_of(std::span<const Eigen::Vector3f> points, double edge_m) {
  std::vector<PointCell> cells;
  cells.reserve(points.size());
  for (const Eigen::Vector3f& p : points) {
    const Eigen::Vector3d point = p.cast<double>();
    if (!(point.array().abs() <= kMaxCoordinateM).all()) continue;
    const Eigen::Vector3d cell = (point / edge_m).array().floor();
    cells.push_back({static_cast<std::int32_t>(cell.x()),
                     static_cast<std::int32_t>(cell.y()),
                     static_cast<std::int32_t>(cell.z())});
  }
  sort_unique(cells);
  std::vector<PointVote> votes;
  votes.reserve(cells.size());
  for (const PointCell& cell : cells) votes.push_back({cell, 1});
  return votes;
}

Eigen::Vector3d centre_of(const PointCell& cell, double edge_m) {
  return edge_m * (Eigen::Vector3d(cell.x, cell.y, cell.z).array() + 0.5);
}

/// The votes of the cell that the middle one of all votes lies in, cells in the order of their
/// votes. Requires: total = the sum of the votes > 0, most = the largest number.
std::uint32_t typical_votes(std::span<const PointVote> votes,
                            std::uint32_t most,
                            std::uint64_t total) {
  constexpr std::uint32_t kMaxCounted = 4096;
  if (most > kMaxCounted) {
    std::vector<std::uint32_t> counts;
    for (const PointVote& vote : votes) counts.push_back(vote.votes);
    std::sort(counts.begin(), counts.end());
    std::uint64_t below = 0;
    std::size_t i = 0;
    while (2 * (below += counts[i]) < total) ++i;
    return counts[i];
  }
  std::vector<std::uint32_t> cells_with(most + 1, 0);
  for (const PointVote& vote : votes) ++cells_with[vote.votes];
  std::uint64_t below = 0;
  std::uint32_t typical = 0;
  while (2 * (below += std::uint64_t{typical} * cells_with[typical]) < total) ++typical;
  return typical;
}

std::vector<PointVote> sum_of(std::span<const PointVote> mine, std::span<const PointVote> votes) {
  std::vector<PointVote> sum;
  sum.reserve(mine.size() + votes.size());
  auto next = mine.begin();
  for (const PointVote& vote : votes) {
    while (next != mine.end() && next->cell < vote.cell) sum.push_back(*next++);
    sum.push_back(vote);
    if (next != mine.end() && next->cell == vote.cell) sum.back().votes += (next++)->votes;
  }
  sum.insert(sum.end(), next, mine.end());
  return sum;
}

void widen(PointEvidenceState& state) {
  state.votes = widened(state.votes);
  state.edge_m *= 2.0;
}

/// The share asked for of what the cell of a typical vote has: half of all votes lie in cells with
/// more. Strays are many cells but few votes.
std::uint32_t votes_needed(const PointEvidenceState& state, const PointEvidenceOptions& options) {
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
void make_room(PointEvidenceState& state, const PointEvidenceOptions& options) {
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

PointEvidence::PointEvidence(const PointEvidenceOptions& options) : options_(options) {
  take({.edge_m = options.edge_m, .num_observations = 0, .votes = {}});
}

Result<PointEvidence> PointEvidence::from_state(const PointEvidenceOptions& options,
                                                PointEvidenceState state) {
  HYPERMAP_TRY(validate(options));
  if (!(state.edge_m <= kMaxCoordinateM)) {
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
  PointEvidence evidence(options);
  evidence.votes_needed_ = votes_needed(state, options);
  evidence.state_ = std::make_shared<const PointEvidenceState>(std::move(state));
  return evidence;
}

void PointEvidence::observe(std::span<const Eigen::Vector3f> points_in_map) {
  take({.edge_m = state_->edge_m,
        .num_observations = state_->num_observations + 1,
        .votes = sum_of(state_->votes, votes_of(points_in_map, state_->edge_m))});
}

void PointEvidence::merge(const PointEvidence& other) {
  assert(options_ == other.options_);
  PointEvidenceState mine = *state_;
  PointEvidenceState added = *other.state_;
  while (added.edge_m < mine.edge_m) widen(added);
  while (mine.edge_m < added.edge_m) widen(mine);
  mine.num_observations += added.num_observations;
  mine.votes = sum_of(mine.votes, added.votes);
  take(std::move(mine));
}

void PointEvidence::take(PointEvidenceState state) {
  make_room(state, options_);
  const std::uint32_t needed = votes_needed(state, options_);
  state_ = std::make_shared<const PointEvidenceState>(std::move(state));
  votes_needed_ = needed;
}

std::vector<Eigen::Vector3d> PointEvidence::agreed_points() const {
  std::vector<Eigen::Vector3d> points;
  points.reserve(state_->votes.size());
  for (const PointVote& vote : state_->votes) {
    if (vote.votes >= votes_needed_) points.push_back(centre_of(vote.cell, state_->edge_m));
  }
  return points;
}

std::optional<Box> PointEvidence::agreed_box() const {
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

Result<Polygon> PointEvidence::footprint() const {
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

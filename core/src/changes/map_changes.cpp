// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/changes/map_changes.hpp"

#include "objects/association/sparse_assignment.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kMaxAskedPoints = 1024;

double distance_m(const ObjectInPlace& a, const ObjectInPlace& b) {
  return (a.centroid_in_map - b.centroid_in_map).norm();
}

std::vector<Eigen::Vector3d> asked_points(const ObjectInPlace& object) {
  if (object.points_in_map.empty()) {
    const auto corners = object.box.corners();
    std::vector<Eigen::Vector3d> points(corners.begin(), corners.end());
    points.push_back(object.box.centre());
    return points;
  }
  const std::size_t all = object.points_in_map.size();
  const std::size_t count = std::min(all, kMaxAskedPoints);
  std::vector<Eigen::Vector3d> points;
  points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) points.push_back(object.points_in_map[i * all / count]);
  return points;
}

SpaceShares shares_of(const ObjectInPlace& object, const MapOfPlace& other) {
  std::array<std::size_t, 3> counts{};
  const auto points = asked_points(object);
  for (const Eigen::Vector3d& point : points) {
    ++counts.at(static_cast<std::size_t>(other.space(PointInMap{point})));
  }
  const auto share = [&](SpaceState state) {
    return static_cast<double>(counts.at(static_cast<std::size_t>(state))) /
           static_cast<double>(points.size());
  };
  return {.free = share(SpaceState::kFree),
          .occupied = share(SpaceState::kOccupied),
          .unknown = share(SpaceState::kUnknown)};
}

/// The objects of a map, what the other map knows of their places, and of which of them nothing is
/// said yet.
struct Side {
  std::span<const ObjectInPlace> objects;
  std::vector<SpaceShares> places;
  std::vector<bool> is_open;

  Side(const MapOfPlace& map, const MapOfPlace& other)
      : objects(map.objects), is_open(map.objects.size(), true) {
    places.reserve(objects.size());
    for (const ObjectInPlace& object : objects) places.push_back(shares_of(object, other));
  }

  [[nodiscard]] std::vector<std::size_t> open() const {
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < is_open.size(); ++i) {
      if (is_open[i]) indices.push_back(i);
    }
    return indices;
  }
};

bool is_known(const SpaceShares& shares, const ChangeOptions& options) {
  return shares.free + shares.occupied >= options.min_known_share;
}

bool is_empty(const SpaceShares& shares, const ChangeOptions& options) {
  return is_known(shares, options) &&
         shares.free >= options.min_free_share * (shares.free + shares.occupied);
}

/// What a pair costs; none: it must not be made.
using PairCost = std::optional<double>;

PairCost cost_if(bool may_be, double cost) {
  return may_be ? PairCost(cost) : std::nullopt;
}

/// The pairs of open objects with the least sum of costs; they are closed.
template <class Cost>
std::vector<IndexPair> closed_pairs(Side& before, Side& after, const Cost& cost) {
  std::vector<CostedPair> candidates;
  const auto others = after.open();
  for (const std::size_t i : before.open()) {
    for (const std::size_t j : others) {
      if (const PairCost of_pair = cost(i, j)) candidates.push_back({{i, j}, *of_pair});
    }
  }
  auto pairs = assign_sparse(candidates);
  for (const IndexPair& pair : pairs) {
    before.is_open[pair.row] = false;
    after.is_open[pair.column] = false;
  }
  return pairs;
}

/// One comparison: the steps of find_changes, in their order.
class Comparison {
 public:
  Comparison(const MapOfPlace& before, const MapOfPlace& after, const ChangeOptions& options)
      : before_(before, after), after_(after, before), before_map_(&before), options_(&options) {}

  void pair_in_place() {
    const auto pairs = closed_pairs(before_, after_, [this](std::size_t i, std::size_t j) {
      const ObjectInPlace& a = before_.objects[i];
      const ObjectInPlace& b = after_.objects[j];
      const double away_m = distance_m(a, b);
      return cost_if(a.class_name == b.class_name && away_m <= gate_m(a, b), away_m);
    });
    for (const IndexPair& pair : pairs) add_pair(kind_in_place(pair), pair);
  }

  void pair_across_classes() {
    std::vector<bool> is_left(before_.objects.size(), false);
    for (const std::size_t i : before_.open()) {
      is_left[i] = before_.objects[i].was_seen_gone || is_empty(before_.places[i], *options_);
    }
    const auto pairs = closed_pairs(before_, after_, [&](std::size_t i, std::size_t j) {
      const double overlap = intersection_over_union(before_.objects[i].box, after_.objects[j].box);
      return cost_if(!is_left[i] && overlap >= options_->min_overlap_share, 1.0 - overlap);
    });
    for (const IndexPair& pair : pairs) add_pair(ChangeKind::kReclassed, pair);
  }

  /// What neither map shares with the other; what is gone and what was added may be one thing.
  void explain_the_rest() {
    std::vector<ChangeKind> was(before_.objects.size(), ChangeKind::kSame);
    std::vector<ChangeKind> is(after_.objects.size(), ChangeKind::kSame);
    for (const std::size_t i : before_.open()) {
      was[i] = kind_alone(
          before_, i, {ChangeKind::kNotLookedAt, ChangeKind::kGone, ChangeKind::kNotFound});
    }
    for (const std::size_t j : after_.open()) {
      is[j] = kind_alone(
          after_, j, {ChangeKind::kFirstSeen, ChangeKind::kAdded, ChangeKind::kNewlyNamed});
    }
    const auto pairs = closed_pairs(before_, after_, [&](std::size_t i, std::size_t j) {
      const bool may_be = was[i] == ChangeKind::kGone && is[j] == ChangeKind::kAdded;
      return may_be ? cost_of_move(i, j) : std::nullopt;
    });
    for (const IndexPair& pair : pairs) add_pair(ChangeKind::kMoved, pair);
    for (const std::size_t i : before_.open()) {
      changes_.push_back(
          {.kind = was[i], .before = before_.objects[i].id, .old_place = before_.places[i]});
    }
    for (const std::size_t j : after_.open()) {
      changes_.push_back(
          {.kind = is[j], .after = after_.objects[j].id, .new_place = after_.places[j]});
    }
  }

  [[nodiscard]] std::vector<ObjectChange> sorted() && {
    const auto key = [](const ObjectChange& change) {
      const auto place = std::ranges::find(kChangeKinds, change.kind) - kChangeKinds.begin();
      return std::tuple(place, change.before, change.after);
    };
    std::ranges::sort(changes_, {}, key);
    return std::move(changes_);
  }

 private:
  struct KindsAlone {
    ChangeKind unknown;
    ChangeKind empty;
    ChangeKind filled;
  };

  [[nodiscard]] double gate_m(const ObjectInPlace& a, const ObjectInPlace& b) const {
    const double side_m =
        std::max(a.box.extent().head<2>().maxCoeff(), b.box.extent().head<2>().maxCoeff());
    return std::max(options_->same_place_m, 0.5 * side_m);
  }

  /// A thing that was pushed aside by less than its size has left its old place, too.
  [[nodiscard]] ChangeKind kind_in_place(const IndexPair& pair) const {
    if (!after_.objects[pair.column].was_looked_at) return ChangeKind::kNotLookedAt;
    const bool has_left = is_empty(before_.places[pair.row], *options_) &&
                          !is_filled(after_.places[pair.column]) &&
                          !is_seen_through(before_.objects[pair.row]);
    return has_left ? ChangeKind::kMoved : ChangeKind::kSame;
  }

  /// Whether the earlier map itself shows its surface as free: rays end behind a pane of glass in
  /// every map. Not asked of corners of a box, which are free beside most things.
  [[nodiscard]] bool is_seen_through(const ObjectInPlace& object) const {
    return !object.points_in_map.empty() && is_empty(shares_of(object, *before_map_), *options_);
  }

  [[nodiscard]] bool is_filled(const SpaceShares& shares) const {
    return is_known(shares, *options_) && !is_empty(shares, *options_);
  }

  [[nodiscard]] ChangeKind kind_alone(const Side& side,
                                      std::size_t index,
                                      const KindsAlone& kinds) const {
    const SpaceShares& place = side.places[index];
    if (side.objects[index].was_seen_gone) return kinds.empty;
    if (!is_known(place, *options_)) return kinds.unknown;
    return is_empty(place, *options_) ? kinds.empty : kinds.filled;
  }

  [[nodiscard]] PairCost cost_of_move(std::size_t i, std::size_t j) const {
    const ObjectInPlace& a = before_.objects[i];
    const ObjectInPlace& b = after_.objects[j];
    const auto [less_m, more_m] = std::minmax({a.box.extent().norm(), b.box.extent().norm()});
    const bool may_be = a.class_name == b.class_name && distance_m(a, b) <= options_->max_move_m &&
                        less_m >= options_->min_size_ratio * more_m;
    return cost_if(may_be, distance_m(a, b));
  }

  void add_pair(ChangeKind kind, const IndexPair& pair) {
    const ObjectInPlace& before = before_.objects[pair.row];
    const ObjectInPlace& after = after_.objects[pair.column];
    changes_.push_back({.kind = kind,
                        .before = before.id,
                        .after = after.id,
                        .distance_m = distance_m(before, after),
                        .old_place = before_.places[pair.row],
                        .new_place = after_.places[pair.column]});
  }

  Side before_;
  Side after_;
  const MapOfPlace* before_map_;
  const ChangeOptions* options_;
  std::vector<ObjectChange> changes_;
};

constexpr std::array<std::string_view, 9> kKindNames{"same",
                                                     "moved",
                                                     "re-classed",
                                                     "gone",
                                                     "not found",
                                                     "not looked at",
                                                     "added",
                                                     "newly named",
                                                     "first seen"};
constexpr std::array<std::string_view, 9> kKindKeys{"same",
                                                    "moved",
                                                    "re_classed",
                                                    "gone",
                                                    "not_found",
                                                    "not_looked_at",
                                                    "added",
                                                    "newly_named",
                                                    "first_seen"};

}  // namespace

std::string_view name_of(ChangeKind kind) noexcept {
  return kKindNames[static_cast<std::size_t>(kind)];
}

std::string_view key_of(ChangeKind kind) noexcept {
  return kKindKeys[static_cast<std::size_t>(kind)];
}

bool is_change(ChangeKind kind) noexcept {
  return kind == ChangeKind::kMoved || kind == ChangeKind::kReclassed ||
         kind == ChangeKind::kGone || kind == ChangeKind::kAdded;
}

std::vector<ObjectChange> find_changes(const MapOfPlace& before,
                                       const MapOfPlace& after,
                                       const ChangeOptions& options) {
  Comparison comparison(before, after, options);
  comparison.pair_in_place();
  comparison.pair_across_classes();
  comparison.explain_the_rest();
  return std::move(comparison).sorted();
}

}  // namespace hypermap

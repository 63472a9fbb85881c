// SPDX-License-Identifier: BSD-3-Clause
#include "overlap.hpp"

#include "geometry/floor_of.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kComparedPoints = 300;

std::vector<ProximityCell> thinned(const std::vector<ProximityCell>& cells) {
  const std::size_t stride = (cells.size() + kComparedPoints - 1) / kComparedPoints;
  std::vector<ProximityCell> out;
  out.reserve(std::min(cells.size(), kComparedPoints));
  for (std::size_t i = 0; i < cells.size(); i += stride) out.push_back(cells[i]);
  return out;
}

PointSet make_point_set(const Box& box,
                        const std::vector<ProximityCell>& cells,
                        std::vector<ClassEvidence> classes) {
  return {box, thinned(cells), std::move(classes), ProximityGrid(cells)};
}

/// Where the centres of an object's cells lie among those of a proximity grid, along one axis: the
/// same number as `proximity_cell_of` the centre.
class AxisCells {
 public:
  /// `low`, `high`: of the coordinates that are going to be asked for.
  AxisCells(std::int32_t low, std::int32_t high, double edge_m, double near_m)
      : low_(low), edge_m_(edge_m), near_m_(near_m) {
    const std::int64_t count = std::int64_t{high} - low + 1;
    if (count > kMaxListed) return;
    known_.reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      known_.push_back(computed(static_cast<std::int32_t>(low + i)));
    }
  }
  [[nodiscard]] std::int64_t at(std::int32_t coordinate) const {
    if (known_.empty()) return computed(coordinate);
    return known_[static_cast<std::size_t>(std::int64_t{coordinate} - low_)];
  }

 private:
  static constexpr std::int64_t kMaxListed = 1024;

  [[nodiscard]] std::int64_t computed(std::int32_t coordinate) const {
    return floor_of(edge_m_ * (coordinate + 0.5) / near_m_);
  }

  std::int32_t low_;
  double edge_m_;
  double near_m_;
  std::vector<std::int64_t> known_;  ///< From low_ on; empty when there are too many.
};

/// The cells of the points that an object's observations agree on.
std::vector<ProximityCell> agreed_cells(const OccupancyVotes& votes, double near_m) {
  const CellAgreement& agreement = votes.agreement();
  const double edge_m = votes.state().edge_m;
  const AxisCells x(agreement.low.x, agreement.high.x, edge_m, near_m);
  const AxisCells y(agreement.low.y, agreement.high.y, edge_m, near_m);
  const AxisCells z(agreement.low.z, agreement.high.z, edge_m, near_m);
  std::vector<ProximityCell> cells;
  cells.reserve(agreement.num_cells);
  const auto standings = votes.standings();
  for (std::size_t i = 0; i < standings.size(); ++i) {
    if (standings[i] != CellStanding::kAgreed) continue;
    const PointCell& cell = votes.state().votes[i].cell;
    cells.push_back({x.at(cell.x), y.at(cell.y), z.at(cell.z)});
  }
  return cells;
}

double box_share(const Box& a, const Box& b) {
  const Eigen::Vector3d common =
      (a.max_in_map.cwiseMin(b.max_in_map) - a.min_in_map.cwiseMax(b.min_in_map)).cwiseMax(0.0);
  return common.prod() / std::min(a.volume_m3(), b.volume_m3());
}

double highest(std::span<const ClassEvidence> classes) {
  double p = 0.0;
  for (const ClassEvidence& e : classes) p = std::max(p, e.probability.value());
  return p;
}

}  // namespace

PointSet point_set_of(const Observation& observation, double near_m) {
  std::vector<ProximityCell> cells;
  cells.reserve(observation.segment.points_in_map.size());
  for (const Eigen::Vector3f& p : observation.segment.points_in_map) {
    cells.push_back(proximity_cell_of(p.cast<double>(), near_m));
  }
  return make_point_set(observation.segment.box, cells, observation.class_scores);
}

PointSet point_set_of(const Object& object, double near_m) {
  PointSet set =
      make_point_set(object.box, agreed_cells(object.points, near_m), object.belief.distribution());
  set.num_observations = std::max(object.num_observations, 1U);
  return set;
}

Overlap measure_overlap(const PointSet& first, const PointSet& second, double near_m) {
  const double first_diagonal = grown(first.box, near_m).extent().norm();
  const double second_diagonal = grown(second.box, near_m).extent().norm();
  Overlap out;
  out.share_of_first = second.grid.share_near(first.cells);
  out.share_of_second = first.grid.share_near(second.cells);
  out.box_share = box_share(grown(first.box, near_m), grown(second.box, near_m));
  out.distance = (first.box.centre() - second.box.centre()).norm() /
                 (0.5 * (first_diagonal + second_diagonal));
  out.growth = grown(bounding_box(first.box, second.box), near_m).extent().norm() /
               std::max(first_diagonal, second_diagonal);
  const bool first_is_part = out.share_of_first >= out.share_of_second;
  const PointSet& part = first_is_part ? first : second;
  const PointSet& whole = first_is_part ? second : first;
  out.diagonal_ratio =
      first_is_part ? first_diagonal / second_diagonal : second_diagonal / first_diagonal;
  out.maturity_ratio = static_cast<double>(part.num_observations) / whole.num_observations;
  out.agreement = class_agreement(first.classes, second.classes);
  return out;
}

double class_agreement(std::span<const ClassEvidence> a, std::span<const ClassEvidence> b) {
  const double top_a = highest(a);
  const double top_b = highest(b);
  if (top_a <= 0.0 || top_b <= 0.0) return 0.0;
  double best = 0.0;
  for (std::size_t i = 0, k = 0; i < a.size() && k < b.size();) {
    if (a[i].id == b[k].id) {
      best = std::max(best,
                      std::min(a[i].probability.value() / top_a, b[k].probability.value() / top_b));
    }
    const bool step_a = a[i].id <= b[k].id;
    const bool step_b = b[k].id <= a[i].id;
    i += step_a ? 1U : 0U;
    k += step_b ? 1U : 0U;
  }
  return best;
}

bool is_same_object(const Overlap& c, const AssignmentOptions& options, double strictness) {
  const double larger = std::max(c.share_of_first, c.share_of_second);
  const double smaller = std::min(c.share_of_first, c.share_of_second);
  if (c.agreement >= options.same_class_agreement) {
    return larger >= strictness * options.same_class_share ||
           c.box_share >= strictness * options.same_class_box_share ||
           c.distance * strictness <= options.same_class_distance;
  }
  return smaller >= strictness * options.other_class_share ||
         (larger >= std::min(0.95, strictness * options.part_share) &&
          c.diagonal_ratio >= strictness * options.part_diagonal &&
          c.maturity_ratio <= options.part_maturity);
}

double affinity(const Overlap& c) {
  const double larger = std::max(c.share_of_first, c.share_of_second);
  const double smaller = std::min(c.share_of_first, c.share_of_second);
  const double nearness = std::max(0.0, 1.0 - c.distance);
  const double likeness = 0.4 * larger + 0.3 * smaller + 0.4 * nearness + 0.6 * c.agreement;
  return 0.05 + std::max(0.0, likeness - 0.5 * (c.growth - 1.0));
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "overlap.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

constexpr std::size_t kComparedPoints = 300;

std::vector<Eigen::Vector3d> thinned(const std::vector<Eigen::Vector3d>& points) {
  const std::size_t stride = (points.size() + kComparedPoints - 1) / kComparedPoints;
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < points.size(); i += stride) out.push_back(points[i]);
  return out;
}

PointSet make_point_set(const Box& box,
                        const std::vector<Eigen::Vector3d>& points,
                        std::vector<ClassEvidence> classes,
                        double near_m) {
  return {box, thinned(points), std::move(classes), ProximityGrid(points, near_m)};
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
  std::vector<Eigen::Vector3d> points;
  points.reserve(observation.segment.points_in_map.size());
  for (const Eigen::Vector3f& p : observation.segment.points_in_map) {
    points.emplace_back(p.cast<double>());
  }
  return make_point_set(observation.segment.box, points, observation.class_scores, near_m);
}

PointSet point_set_of(const Object& object, double near_m) {
  return make_point_set(
      object.box, object.points.agreed_points(), object.belief.distribution(), near_m);
}

Overlap measure_overlap(const PointSet& first, const PointSet& second, double near_m) {
  const double first_diagonal = grown(first.box, near_m).extent().norm();
  const double second_diagonal = grown(second.box, near_m).extent().norm();
  Overlap out;
  out.share_of_first = second.grid.share_near(first.points);
  out.share_of_second = first.grid.share_near(second.points);
  out.box_share = box_share(grown(first.box, near_m), grown(second.box, near_m));
  out.distance = (first.box.centre() - second.box.centre()).norm() /
                 (0.5 * (first_diagonal + second_diagonal));
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
  return 0.05 + 0.4 * larger + 0.3 * smaller + 0.4 * nearness + 0.6 * c.agreement;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/projected_shape.hpp"
#include "policies.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace hypermap {
namespace {

using CandidateFinder = std::function<std::vector<ObjectId>(const Observation&, const Polygon&)>;

/// The observation is evidence of all `ids`, which become one or stay apart.
/// Source: [hypermap] 3.4.5.
void match_several(AssociationRun& run, std::size_t observation, const std::vector<ObjectId>& ids) {
  if (run.options.several_matches == SeveralMatches::kKeepApart) {
    for (const ObjectId id : ids) run.match(observation, id);
    run.report.object_of_observation[observation] = ids.front();
    return;
  }
  ObjectId into = ids.front();
  for (std::size_t k = 1; k < ids.size(); ++k) into = run.merge(into, ids[k]);
  run.match(observation, into);
}

/// One observation after the other. Source: [hypermap] 3.4.5.
void associate_each(AssociationRun& run, const CandidateFinder& candidates_of) {
  for (std::size_t i = 0; i < run.observations.size(); ++i) {
    if (run.is_transient(i)) continue;
    const Observation& observation = run.observations[i];
    const auto shape = projected_hull(observation.segment.points_in_map, run.options.shape_leaf_m);
    if (!shape) {
      ++run.report.num_without_shape;
      continue;
    }
    const std::vector<ObjectId> ids = candidates_of(observation, *shape);
    if (ids.empty()) {
      run.create(i);
    } else {
      match_several(run, i, ids);
    }
  }
}

/// Objects of the observation's class whose boxes meet the area.
std::vector<ObjectId> same_class_within(const AssociationRun& run,
                                        const Observation& observation,
                                        const Rect& area) {
  std::vector<ObjectId> ids = run.objects.query(area);
  const ClassId id = named_class(observation);
  std::erase_if(ids, [&](ObjectId object) { return !is_of_class(run.objects.at(object), id); });
  return ids;
}

/// Steps 1 and 2 of figure 3.22: the nearest object that may be it.
std::optional<ObjectId> nearest_candidate(const AssociationRun& run,
                                          const Eigen::Vector3d& centroid,
                                          ClassId class_id,
                                          std::optional<ObjectId> except,
                                          const ObjectScope& scope) {
  const double max_distance_m = run.options.position_error_m * run.options.tracking_factor;
  std::optional<ObjectId> best;
  double best_distance = std::numeric_limits<double>::infinity();
  const Box around{centroid.array() - max_distance_m, centroid.array() + max_distance_m};
  for (const ObjectId id : run.objects.query(around)) {
    const Object& object = run.objects.at(id);
    const double distance = (object.centroid_in_map - centroid).norm();
    if (!(distance < max_distance_m) || !(distance < best_distance)) continue;  // C.2.3
    const bool may_be = id != except && is_of_class(object, class_id) &&        // C.2.1
                        scope.contains(object.centroid_in_map);                 // 1, C.2.2
    if (!may_be) continue;
    best = id;
    best_distance = distance;
  }
  return best;
}

/// Step 5 of figure 3.22: instances that are close enough become one.
void combine_close(AssociationRun& run, ObjectId id, const ObjectScope& scope) {
  const Object& object = run.objects.at(id);
  const auto best = object.belief.best();
  const auto other = nearest_candidate(run, object.centroid_in_map, best->id, id, scope);
  if (other) run.merge(id, *other);
}

}  // namespace

void associate_by_overlap(AssociationRun& run) {
  associate_each(run, [&](const Observation& observation, const Polygon& shape) {
    std::vector<ObjectId> ids = same_class_within(run, observation, bounds(shape));
    std::erase_if(ids, [&](ObjectId id) {
      const auto other = footprint(run.objects.at(id), run.options.shape);
      return !other || !(jaccard(shape, *other) > run.options.min_jaccard);
    });
    return ids;
  });
}

void associate_by_radius(AssociationRun& run) {
  associate_each(run, [&](const Observation& observation, const Polygon& shape) {
    const Eigen::Vector2d centre = centroid(shape);
    const double radius_m = run.options.radius_m;
    return same_class_within(
        run, observation, {centre.array() - radius_m, centre.array() + radius_m});
  });
}

void associate_by_smap(AssociationRun& run, const ObjectScope& scope) {
  for (std::size_t i = 0; i < run.observations.size(); ++i) {
    if (run.is_transient(i)) continue;
    const Observation& observation = run.observations[i];
    const auto candidate = nearest_candidate(
        run, observation.segment.centroid_in_map, named_class(observation), std::nullopt, scope);
    if (!candidate) {
      run.create(i);  // step 3
      continue;
    }
    run.match(i, *candidate);  // step 4
    combine_close(run, *candidate, scope);
  }
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/association.hpp"

#include "hypermap/core/segmentation/masks.hpp"
#include "policies.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

void sort_and_unite(std::vector<ObjectId>& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// Ids that were merged away give way to those that stayed.
void apply_merges(AssociationReport& report) {
  for (const auto& [from, into] : report.merged) {
    for (auto* ids : {&report.object_of_observation, &report.created, &report.matched}) {
      std::replace(ids->begin(), ids->end(), from, into);
    }
  }
  sort_and_unite(report.matched);
  sort_and_unite(report.created);
  std::erase_if(report.created, [&](ObjectId id) {
    return std::binary_search(report.matched.begin(), report.matched.end(), id);
  });
}

}  // namespace

double bearing_from_object_rad(const Eigen::Vector3d& object_in_map,
                               const Eigen::Vector3d& camera_in_map) {
  return std::atan2(camera_in_map.y() - object_in_map.y(), camera_in_map.x() - object_in_map.x());
}

Observation make_observation(const RgbdFrame& frame, const Detection& detection, Segment segment) {
  const Eigen::Vector3d camera = frame.map_from_camera.origin().xyz;
  Observation out;
  out.class_scores = detection.class_scores;
  out.score = detection.score;
  out.detector = detection.detector;
  out.embeddings = detection.embeddings;
  out.box_px = box_with_mask(detection);
  out.bearing_rad = bearing_from_object_rad(segment.centroid_in_map, camera);
  out.distance_m = segment.distance_m;
  out.stamp = frame.stamp;
  out.frame_index = frame.index;
  out.segment = std::move(segment);
  return out;
}

ClassId named_class(const Observation& observation) {
  const auto best = best_class(observation.class_scores);
  assert(best.has_value());
  return best->id;
}

bool is_of_class(const Object& object, ClassId id) {
  const auto best = object.belief.best();
  return best && best->id == id;
}

bool AssociationRun::is_transient(std::size_t observation) {
  const auto& transient = options.transient_classes;
  const ClassId id = named_class(observations[observation]);
  const bool found = std::find(transient.begin(), transient.end(), id) != transient.end();
  report.num_transient += found ? 1U : 0U;
  return found;
}

void AssociationRun::create(std::size_t observation) {
  const ObjectId id = objects.add(make_object(observations[observation], options));
  report.object_of_observation[observation] = id;
  report.created.push_back(id);
}

void AssociationRun::match(std::size_t observation, ObjectId id) {
  objects.modify(
      id, [&](Object& object) { update_object(object, observations[observation], options); });
  report.object_of_observation[observation] = id;
  report.matched.push_back(id);
}

ObjectId AssociationRun::merge(ObjectId a, ObjectId b) {
  const ObjectId into = std::min(a, b);
  const ObjectId from = std::max(a, b);
  objects.replace(merged(objects.at(into), objects.at(from), options.max_existence));
  objects.erase(from);
  report.merged.push_back({from, into});
  return into;
}

AssociationReport associate(ObjectMap& objects,
                            std::span<const Observation> observations,
                            const AssociationOptions& options,
                            const ObjectScope& scope) {
  AssociationRun run{objects, observations, options, {}};
  run.report.object_of_observation.assign(observations.size(), kNoObject);
  switch (options.policy) {
    case AssociationPolicy::kAssignment:
      associate_by_assignment(run);
      break;
    case AssociationPolicy::kOverlap:
      associate_by_overlap(run);
      break;
    case AssociationPolicy::kRadius:
      associate_by_radius(run);
      break;
    case AssociationPolicy::kSmap:
      associate_by_smap(run, scope);
      break;
  }
  apply_merges(run.report);
  return std::move(run.report);
}

}  // namespace hypermap

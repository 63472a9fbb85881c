// SPDX-License-Identifier: BSD-3-Clause
// The topological map: it grows with the sensor's way and toward objects, and tells of their
// places.
#include "mapper/topological_growth.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"
#include "hypermap/octree_semantic/octree/free_way.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

/// No way is guessed over more: a pose that is so far off is no step, an object no neighbour.
constexpr double kFarthestM = 100.0;

void grow_toward(const Object& object, TopologicalMap& map) {
  const Eigen::Vector3d& centre = object.centroid_in_map;
  if (centre.cwiseAbs().maxCoeff() > TopologicalMap::kMaxCoordinateM) return;
  const Eigen::Vector3d& nearest = map.vertices()[map.nearest(centre)->value].position_in_map;
  if ((centre - nearest).norm() <= kFarthestM) map.cover(centre);
}

Box grown_by(const Box& box, double margin_m) {
  return {box.min_in_map.array() - margin_m, box.max_in_map.array() + margin_m};
}

/// Objects whose centres the frame may have moved: those that it showed, and those beside them,
/// which may have lost cells to them or given their own. Ascending.
std::vector<ObjectId> moved_objects(const ObjectMap& objects,
                                    const AssociationReport& association,
                                    double margin_m) {
  std::vector<ObjectId> moved;
  for (const ObjectId id : association.object_of_observation) {
    if (!objects.contains(id)) continue;
    const auto beside = objects.query(grown_by(objects.at(id).box, margin_m));
    moved.insert(moved.end(), beside.begin(), beside.end());
  }
  std::ranges::sort(moved);
  moved.erase(std::unique(moved.begin(), moved.end()), moved.end());
  return moved;
}

}  // namespace

Result<TopologicalMap> topological_map_of(std::optional<TopologicalMap> before,
                                          const TopologicalMapOptions& options) {
  if (!before) return TopologicalMap(options);
  if (before->options() == options) return *std::move(before);
  return fail(ErrorCode::kInvalidArgument,
              "the map to go on from has other options of the topological map (vertices " +
                  number_text(before->options().vertex_distance_m) + " m, edges " +
                  number_text(before->options().edge_factor) + " of that)",
              "places");
}

void SemanticMapper::grow_topological_map(const PointInMap& sensor,
                                          const AssociationReport& association) {
  const bool is_new = topological_map_.vertices().empty();
  const auto& walk = topological_map_.walk();
  if (walk && (sensor.xyz - walk->position_in_map).norm() > kFarthestM) {
    topological_map_.interrupt();
  }
  topological_map_.observe(sensor.xyz,
                           [this](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
                             return is_way_free(octree_, from, to);
                           });
  if (is_new) {
    for (const Object& object : objects_.objects()) grow_toward(object, topological_map_);
    return;
  }
  const double margin_m = options_.places.vertex_distance_m;
  for (const ObjectId id : moved_objects(objects_, association, margin_m)) {
    grow_toward(objects_.at(id), topological_map_);
  }
}

void SemanticMapper::inform(std::vector<Observation>& observations) const {
  for (Observation& observation : observations) {
    observation.num_classes = classes_->size();
    if (!prior_source_) continue;
    observation.prior = prior_source_->prior_of(observation, objects_, topological_map_, *classes_);
  }
}

}  // namespace hypermap

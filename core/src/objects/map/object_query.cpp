// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_query.hpp"

#include "hypermap/core/objects/object.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <string>

namespace hypermap {
namespace {

bool box_holds(const Box& box, const PlanPoint& point) {
  return box.contains({point.xy.x(), point.xy.y(), point.z.value_or(box.min_in_map.z())});
}

bool box_intersects(const Box& box, const Polygon& area) {
  const Eigen::Vector2d low = box.min_in_map.head<2>();
  const Eigen::Vector2d high = box.max_in_map.head<2>();
  const auto outline = make_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  return outline ? intersects(*outline, area) : contains(area, low);
}

bool fulfils(const Object& object, const ObjectQuery& query) {
  if (query.id && *query.id != object.id) return false;
  if (query.among && !std::binary_search(query.among->begin(), query.among->end(), object.id)) {
    return false;
  }
  if (query.at && !box_holds(object.box, *query.at)) return false;
  return !query.area || box_intersects(object.box, *query.area);
}

/// Of the classes that bear these names.
std::set<ClassId> ids_of(const NameSelection& names, const ClassRegistry& classes) {
  std::set<ClassId> ids;
  for (const std::string& name : names.canonical_names()) {
    if (const auto id = classes.find(name)) ids.insert(*id);
  }
  return ids;
}

bool is_of_one(const Object& object, const std::set<ClassId>& ids) {
  const auto best = best_class(object);
  return best && ids.contains(best->id);
}

double distance_m(const Object& object, const PlanPoint& point) {
  const Eigen::Vector3d& centre = object.centroid_in_map;
  const double z = point.z.value_or(centre.z());
  return (centre - Eigen::Vector3d(point.xy.x(), point.xy.y(), z)).norm();
}

}  // namespace

std::vector<ObjectId> find_objects(const ObjectMap& objects,
                                   const ClassRegistry& classes,
                                   const ObjectQuery& query) {
  const auto wanted =
      query.class_name ? std::optional(ids_of(*query.class_name, classes)) : std::nullopt;
  std::vector<ObjectId> found;
  for (const Object& object : objects.objects()) {
    if (wanted && !is_of_one(object, *wanted)) continue;
    if (fulfils(object, query)) found.push_back(object.id);
  }
  return found;
}

std::vector<ObjectId> objects_of_class(const ObjectMap& objects,
                                       const ClassRegistry& classes,
                                       const NameSelection& class_names) {
  return find_objects(objects, classes, {.class_name = class_names});
}

std::optional<ObjectId> nearest_object(const ObjectMap& objects,
                                       const ClassRegistry& classes,
                                       const ObjectQuery& query,
                                       const PlanPoint& point) {
  std::optional<ObjectId> nearest;
  double least_m = std::numeric_limits<double>::infinity();
  for (const ObjectId id : find_objects(objects, classes, query)) {
    const double here_m = distance_m(objects.at(id), point);
    if (here_m >= least_m) continue;
    least_m = here_m;
    nearest = id;
  }
  return nearest;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_query.hpp"

#include "objects/association/policies.hpp"

#include <algorithm>
#include <limits>

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

double distance_m(const Object& object, const PlanPoint& point) {
  const Eigen::Vector3d& centre = object.centroid_in_map;
  const double z = point.z.value_or(centre.z());
  return (centre - Eigen::Vector3d(point.xy.x(), point.xy.y(), z)).norm();
}

}  // namespace

std::vector<ObjectId> find_objects(const ObjectMap& objects,
                                   const ClassRegistry& classes,
                                   const ObjectQuery& query) {
  std::optional<ClassId> wanted;
  if (query.class_name) {
    wanted = classes.find(*query.class_name);
    if (!wanted) return {};
  }
  std::vector<ObjectId> found;
  for (const Object& object : objects.objects()) {
    if (wanted && !is_of_class(object, *wanted)) continue;
    if (fulfils(object, query)) found.push_back(object.id);
  }
  return found;
}

std::vector<ObjectId> objects_of_class(const ObjectMap& objects,
                                       const ClassRegistry& classes,
                                       std::string_view class_name) {
  return find_objects(objects, classes, {.class_name = std::string(class_name)});
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

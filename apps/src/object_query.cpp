// SPDX-License-Identifier: BSD-3-Clause
#include "object_query.hpp"

#include "hypermap/core/objects/object.hpp"
#include "hypermap/io/archive/map_layers.hpp"

#include <limits>

namespace hypermap::app {
namespace {

std::optional<ClassId> class_of(const Object& object) {
  const auto best = best_class(object);
  return best ? std::optional(best->id) : std::nullopt;
}

QueryAnswer answer(const MapArchive& archive, const Object& object) {
  const Eigen::Vector3d& centre = object.centroid_in_map;
  const Eigen::Vector3d extent = object.box.extent();
  const auto id = class_of(object);
  return {.id = object.id.value,
          .name = id ? archive.classes.name(*id) : "unknown",
          .value = object.id.value,
          .position = {centre.x(), centre.y(), centre.z()},
          .confidence = object_confidence(object).value(),
          .size_m = std::vector{extent.x(), extent.y(), extent.z()}};
}

bool box_holds(const Box& box, const std::vector<double>& point) {
  const double z = point.size() > 2 ? point[2] : box.min_in_map.z();
  return box.contains({point[0], point[1], z});
}

bool box_meets(const Box& box, const Polygon& area) {
  const Eigen::Vector2d low = box.min_in_map.head<2>();
  const Eigen::Vector2d high = box.max_in_map.head<2>();
  const auto outline = make_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  return outline ? intersects(*outline, area) : contains(area, low);
}

bool matches(const MapArchive& archive, const Object& object, const ObjectQuery& query) {
  if (query.name) {
    const auto wanted = archive.classes.find(*query.name);
    if (!wanted || class_of(object) != wanted) return false;
  }
  if (query.id && *query.id != object.id.value) return false;
  if (query.at && !box_holds(object.box, *query.at)) return false;
  return !query.area || box_meets(object.box, *query.area);
}

double distance_m(const Object& object, const std::vector<double>& point) {
  Eigen::Vector3d offset = object.centroid_in_map;
  offset.x() -= point[0];
  offset.y() -= point[1];
  offset.z() = point.size() > 2 ? offset.z() - point[2] : 0.0;
  return offset.norm();
}

}  // namespace

std::vector<QueryAnswer> find_objects(const MapArchive& archive, const ObjectQuery& query) {
  std::vector<QueryAnswer> answers;
  for (const Object* object : shown_objects(archive)) {
    if (matches(archive, *object, query)) answers.push_back(answer(archive, *object));
  }
  return answers;
}

Result<std::vector<QueryAnswer>> nearest_object(const MapArchive& archive,
                                                const std::string& class_name,
                                                const std::vector<double>& point) {
  const Object* nearest = nullptr;
  double least_m = std::numeric_limits<double>::infinity();
  const auto wanted = archive.classes.find(class_name);
  for (const Object* object : shown_objects(archive)) {
    if (!wanted || class_of(*object) != wanted) continue;
    const double here_m = distance_m(*object, point);
    if (here_m >= least_m) continue;
    least_m = here_m;
    nearest = object;
  }
  if (nearest == nullptr) {
    return fail(ErrorCode::kNotFound, "no object of class '" + class_name + "'", "--nearest");
  }
  return std::vector{answer(archive, *nearest)};
}

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/objects_layer.hpp"

#include "hypermap/core/objects/object.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/projection/layers/layer_members.hpp"

#include <string>

namespace hypermap {
namespace {

std::string name_of(const Object& object, const ClassRegistry& classes) {
  const auto best = best_class(object);
  return best ? classes.name(best->id) : "unknown";
}

LayerAnswer answer_of(const Object& object, const ClassRegistry& classes) {
  const Eigen::Vector3d& centre = object.centroid_in_map;
  return {.id = object.id.value,
          .name = name_of(object, classes),
          .value = object.id.value,
          .position = centre.head<2>(),
          .confidence = object_confidence(object).value(),
          .z_m = centre.z(),
          .size_m = object.box.extent()};
}

/// Whether the object is asked for by the name of its class, in any spelling of it.
bool is_named(const Object& object, const ClassRegistry& classes, const std::string& text) {
  const auto best = best_class(object);
  return best ? classes.find(text) == best->id : text == "unknown";
}

bool box_holds(const Box& box, const PlanPoint& point) {
  return box.contains({point.xy.x(), point.xy.y(), point.z.value_or(box.min_in_map.z())});
}

bool box_meets(const Box& box, const Polygon& area) {
  const Eigen::Vector2d low = box.min_in_map.head<2>();
  const Eigen::Vector2d high = box.max_in_map.head<2>();
  const auto outline = make_polygon({low, {high.x(), low.y()}, high, {low.x(), high.y()}});
  return outline ? intersects(*outline, area) : contains(area, low);
}

bool is_asked_for(const Object& object, const ClassRegistry& classes, const LayerQuery& query) {
  return (!query.text || is_named(object, classes, *query.text)) &&
         (!query.value || *query.value == object.id.value) &&
         (!query.at || box_holds(object.box, *query.at)) &&
         (!query.area || box_meets(object.box, *query.area));
}

}  // namespace

std::string_view ObjectsLayer::class_name() const {
  return kObjectsFormat;
}

LayerStatistics ObjectsLayer::statistics() const {
  LayerStatistics statistics{.num_objects = shown_.size(),
                             .num_tentative = objects_.size() - shown_.size()};
  Eigen::AlignedBox3d box;
  for (const ObjectId id : shown_) {
    const Box& one = objects_.at(id).box;
    box.extend(Eigen::AlignedBox3d(one.min_in_map, one.max_in_map));
  }
  if (!box.isEmpty()) statistics.bounds = box;
  return statistics;
}

Result<std::vector<LayerAnswer>> ObjectsLayer::query(const LayerQuery& query) const {
  std::vector<LayerAnswer> answers;
  for (const ObjectId id : shown_) {
    const Object& object = objects_.at(id);
    if (is_asked_for(object, classes_, query)) answers.push_back(answer_of(object, classes_));
  }
  return answers;
}

std::vector<LayerPrimitive> ObjectsLayer::draw() const {
  std::vector<LayerPrimitive> primitives;
  for (const ObjectId id : shown_) {
    const Object& object = objects_.at(id);
    primitives.emplace_back(
        DrawnBox{.box = object.box, .class_name = name_of(object, classes_)});
  }
  return primitives;
}

Result<void> ObjectsLayer::save(LayerWriter& writer) const {
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_objects(objects_));
  return writer.bytes("", std::move(bytes));
}

bool ObjectsLayer::equals(const MapLayer& other) const {
  return is_same_layer(*this, other);
}

}  // namespace hypermap

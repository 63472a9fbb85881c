// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/objects_layer.hpp"

#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "hypermap/core/objects/object_query.hpp"
#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/object_json.hpp"
#include "hypermap/projection/layers/layer_members.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace hypermap {
namespace {

std::string name_of(const std::optional<ClassEvidence>& best, const ClassRegistry& classes) {
  return best ? classes.name(best->id) : "unknown";
}

LayerAnswer answer_of(const Object& object,
                      const ClassRegistry& classes,
                      const std::map<ObjectId, double>& confidence) {
  const Eigen::Vector3d& centre = object.centroid_in_map;
  const auto known = confidence.find(object.id);
  ObjectBeliefs beliefs = object_beliefs(object);
  const auto best = beliefs.classes.empty() ? std::nullopt : std::optional(beliefs.classes.front());
  return {.id = object.id.value,
          .name = name_of(best, classes),
          .value = object.id.value,
          .position = centre.head<2>(),
          .confidence = known == confidence.end() ? beliefs.confidence.value() : known->second,
          .z_m = centre.z(),
          .size_m = object.box.extent(),
          .beliefs = std::move(beliefs)};
}

/// No object bears a number that is no id.
ObjectId id_of(std::int64_t value) {
  const bool is_id = value > 0 && value <= std::numeric_limits<std::uint32_t>::max();
  return is_id ? ObjectId{static_cast<std::uint32_t>(value)} : kNoObject;
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
  ObjectQuery conditions{
      .class_name = query.text, .at = query.at, .area = query.area, .among = shown_};
  if (query.value) conditions.id = id_of(*query.value);
  std::vector<LayerAnswer> answers;
  for (const ObjectId id : find_objects(objects_, classes_, conditions)) {
    answers.push_back(answer_of(objects_.at(id), classes_, confidence_));
  }
  return answers;
}

std::vector<LayerPrimitive> ObjectsLayer::draw() const {
  std::vector<LayerPrimitive> primitives;
  for (const ObjectId id : shown_) {
    const Object& object = objects_.at(id);
    primitives.emplace_back(DrawnBox{.box = object.box,
                                     .class_name = name_of(best_class(object), classes_),
                                     .id = object.id.value});
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

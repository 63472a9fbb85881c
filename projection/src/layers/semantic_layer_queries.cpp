// SPDX-License-Identifier: BSD-3-Clause
// What a semantic layer does as one of many types of layers.
#include "hypermap/projection/layers/layer_members.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <iterator>
#include <string>

namespace hypermap {
namespace {

using ObjectIds = std::vector<std::uint64_t>;

LayerAnswer answer_of(const SemanticObject& object) {
  return {.id = object.id,
          .name = object.name,
          .value = static_cast<std::int64_t>(object.id),
          .position = position_of(object),
          .confidence = confidence_of(object)};
}

ObjectIds all_ids(const SemanticLayer& layer) {
  ObjectIds ids;
  for (const SemanticObject& object : layer.objects()) ids.push_back(object.id);
  return ids;
}

/// The ids of both lists, each ascending. Source: [hypermap] 3.3.3.
ObjectIds intersection(const ObjectIds& a, const ObjectIds& b) {
  ObjectIds both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

ObjectIds ids_of_names(const SemanticLayer& layer, const NameSelection& names) {
  ObjectIds ids;
  for (const std::string& name : names.canonical_names()) {
    const ObjectIds of_name = layer.of_class(name);
    ids.insert(ids.end(), of_name.begin(), of_name.end());
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

ObjectIds ids_of_value(const SemanticLayer& layer, std::int64_t value) {
  const auto id = static_cast<std::uint64_t>(value);
  return value >= 0 && layer.find(id) != nullptr ? ObjectIds{id} : ObjectIds{};
}

ObjectIds ids_of(const SemanticLayer& layer, const LayerQuery& query) {
  std::vector<ObjectIds> conditions;
  if (query.text) conditions.push_back(ids_of_names(layer, *query.text));
  if (query.value) conditions.push_back(ids_of_value(layer, *query.value));
  if (query.at) conditions.push_back(layer.at(query.at->xy));
  if (query.area) conditions.push_back(layer.in(*query.area));
  if (conditions.empty()) return all_ids(layer);
  ObjectIds ids = std::move(conditions.front());
  for (std::size_t i = 1; i < conditions.size(); ++i) ids = intersection(ids, conditions[i]);
  return ids;
}

}  // namespace

LayerStatistics SemanticLayer::statistics() const {
  LayerStatistics statistics{.num_objects = objects().size()};
  if (objects().empty()) return statistics;
  Eigen::AlignedBox3d box;
  for (const SemanticObject& object : objects()) {
    const Rect rect = bounds_of(object);
    box.extend(Eigen::Vector3d(rect.min.x(), rect.min.y(), 0.0));
    box.extend(Eigen::Vector3d(rect.max.x(), rect.max.y(), 0.0));
  }
  statistics.bounds = box;
  return statistics;
}

Result<std::vector<LayerAnswer>> SemanticLayer::query(const LayerQuery& query) const {
  std::vector<LayerAnswer> answers;
  for (const std::uint64_t id : ids_of(*this, query)) answers.push_back(answer_of(*find(id)));
  return answers;
}

std::vector<LayerPrimitive> SemanticLayer::draw() const {
  std::vector<LayerPrimitive> primitives;
  for (const SemanticObject& object : objects()) {
    primitives.emplace_back(
        DrawnArea{.parts = object.parts, .class_name = object.name, .id = object.id});
  }
  return primitives;
}

Result<void> SemanticLayer::save(LayerWriter& writer) const {
  return writer.shapes("", *this);
}

Result<LayerContent> SemanticLayer::updated(const LayerContent& update) const {
  const auto* shapes = update.as<SemanticLayer>();
  if (shapes == nullptr) return MapLayer::updated(update);
  SemanticLayer layer = *this;
  for (const SemanticObject& object : shapes->objects()) {
    layer.erase(object.id);
    HYPERMAP_TRY(layer.add(object));
  }
  return LayerContent(std::move(layer));
}

bool SemanticLayer::equals(const MapLayer& other) const {
  return is_same_layer(*this, other);
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_query.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/hypermap_query.hpp"

#include <limits>
#include <utility>

namespace hypermap {
namespace {

MapAnswer answer_of(const LayerAnswer& found) {
  return {.id = found.id,
          .name = found.name,
          .value = found.value,
          .position = {found.position},
          .confidence = found.confidence};
}

MapAnswer answer_of(const Object& object, const ClassRegistry& classes) {
  const Eigen::Vector3d& centre = object.centroid_in_map;
  const auto best = best_class(object);
  return {.id = object.id.value,
          .name = best ? classes.name(best->id) : "unknown",
          .value = object.id.value,
          .position = {centre.head<2>(), centre.z()},
          .confidence = object_confidence(object).value(),
          .size_m = object.box.extent()};
}

std::vector<ObjectId> shown_ids(const MapArchive& archive) {
  std::vector<ObjectId> ids;
  for (const Object* object : shown_objects(archive)) ids.push_back(object->id);
  return ids;
}

/// No object bears a number that is no id.
ObjectId id_of(std::int64_t value) {
  const bool is_id = value > 0 && value <= std::numeric_limits<std::uint32_t>::max();
  return is_id ? ObjectId{static_cast<std::uint32_t>(value)} : kNoObject;
}

MapAnswers ask_objects(const MapArchive& archive, const MapQuery& query) {
  ObjectQuery conditions{
      .class_name = query.text, .at = query.at, .area = query.area, .among = shown_ids(archive)};
  if (query.value) conditions.id = id_of(*query.value);
  MapAnswers answers{.frame_id = "map", .found = {}};
  for (const ObjectId id : find_objects(archive.objects, archive.classes, conditions)) {
    answers.found.push_back(answer_of(archive.objects.at(id), archive.classes));
  }
  return answers;
}

Result<void> check_conditions(const MapQuery& query) {
  const bool combined = query.area || query.text || query.value;
  if (!query.at && !combined) {
    return fail(ErrorCode::kInvalidArgument, "needs a point, an area, a text or a value");
  }
  if (query.at && combined) {
    return fail(ErrorCode::kInvalidArgument, "stands alone on a 2D layer", "at");
  }
  if (query.text && query.value) {
    return fail(ErrorCode::kInvalidArgument, "excludes a value on a 2D layer", "text");
  }
  return {};
}

Result<std::vector<LayerAnswer>> ask_layer(const Hypermap& hypermap, const MapQuery& query) {
  const QueryScope scope{query.layer, query.frame_id};
  if (query.text) return query_string(hypermap, scope, *query.text, query.area);
  if (query.value) return query_int(hypermap, scope, *query.value, query.area);
  if (query.area) return query_area(hypermap, scope, *query.area);
  return query_at(hypermap, scope, query.at->xy);
}

}  // namespace

Result<MapAnswers> query_map(const MapArchive& archive, const MapQuery& query) {
  if (query.layer == kObjectsLayer) return ask_objects(archive, query);
  HYPERMAP_TRY(check_conditions(query));
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer, archive.hypermap.at(query.layer));
  HYPERMAP_ASSIGN_OR_RETURN(const auto found, ask_layer(archive.hypermap, query));
  MapAnswers answers{.frame_id = query.frame_id.empty() ? layer->info.frame_id : query.frame_id,
                     .found = {}};
  for (const LayerAnswer& one : found) answers.found.push_back(answer_of(one));
  return answers;
}

Result<MapAnswers> query_nearest(const MapArchive& archive,
                                 std::string_view class_name,
                                 const PlanPoint& point) {
  const ObjectQuery query{.class_name = std::string(class_name), .among = shown_ids(archive)};
  const auto nearest = nearest_object(archive.objects, archive.classes, query, point);
  if (!nearest) {
    return fail(ErrorCode::kNotFound, "no object of class '" + std::string(class_name) + "'");
  }
  return MapAnswers{.frame_id = "map",
                    .found = {answer_of(archive.objects.at(*nearest), archive.classes)}};
}

}  // namespace hypermap

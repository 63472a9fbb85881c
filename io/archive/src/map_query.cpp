// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_query.hpp"

#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/hypermap_query.hpp"

#include <utility>

namespace hypermap {
namespace {

MapAnswer answer_of(const LayerAnswer& found) {
  return {.id = found.id,
          .name = found.name,
          .value = found.value,
          .position = {found.position, found.z_m},
          .confidence = found.confidence,
          .size_m = found.size_m};
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
  for (const Object* object : confirmed_objects_of(archive)) ids.push_back(object->id);
  return ids;
}

/// What a flat layer can be asked. Errors: kInvalidArgument.
Result<void> check_flat(const MapQuery& query) {
  const bool combined = query.area || query.text || query.value;
  if (!query.at && !combined) {
    return fail(ErrorCode::kInvalidArgument, "needs a point, an area, a text or a value", "layer");
  }
  if (query.at && query.at->z) {
    return fail(ErrorCode::kInvalidArgument, "takes 2 numbers on a 2D layer", "at");
  }
  if (query.at && combined) {
    return fail(ErrorCode::kInvalidArgument, "goes alone on a 2D layer", "at");
  }
  if (query.text && query.value) {
    return fail(ErrorCode::kInvalidArgument, "text and value exclude each other on a 2D layer");
  }
  return {};
}

}  // namespace

Result<MapAnswers> query_map(const MapArchive& archive, const MapQuery& query) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer layer, archive_layer(archive, query.layer));
  if (layer.content->is_flat()) HYPERMAP_TRY(check_flat(query));
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto found,
      query_layer(layer,
                  archive.hypermap.frames(),
                  query.frame_id,
                  {.text = query.text, .value = query.value, .at = query.at, .area = query.area}));
  MapAnswers answers{.frame_id = query.frame_id.empty() ? layer.info.frame_id : query.frame_id,
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

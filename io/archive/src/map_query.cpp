// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_query.hpp"

#include "asked_conditions.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/hypermap_query.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

MapAnswer answer_of(LayerAnswer found) {
  return {.id = found.id,
          .name = std::move(found.name),
          .value = found.value,
          .position = {found.position, found.z_m},
          .confidence = found.confidence,
          .size_m = found.size_m,
          .beliefs = std::move(found.beliefs)};
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

/// The names that the text asks for. Errors: those of asked_of_map, of the member `text`.
Result<std::optional<NameSelection>> asked_text(const MapArchive& archive, const MapQuery& query) {
  if (!query.text) return std::optional<NameSelection>();
  auto names = asked_of_map(archive, *query.text);
  if (names) return std::optional(std::move(*names));
  names.error().field = "string";
  return Unexpected(std::move(names).error());
}

/// What a layer answers to conditions that it can be asked. Errors: those of query_map.
Result<MapAnswers> answers_of(const MapArchive& archive,
                              const Layer& layer,
                              const MapQuery& query) {
  HYPERMAP_TRY(check_frame(archive, query.frame_id));
  HYPERMAP_ASSIGN_OR_RETURN(const auto text, asked_text(archive, query));
  HYPERMAP_ASSIGN_OR_RETURN(
      auto found,
      query_layer(layer,
                  archive.hypermap.frames(),
                  query.frame_id,
                  {.text = text, .value = query.value, .at = query.at, .area = query.area}));
  MapAnswers answers{.frame_id = query.frame_id.empty() ? layer.info.frame_id : query.frame_id,
                     .found = {}};
  for (LayerAnswer& one : found) answers.found.push_back(answer_of(std::move(one)));
  return answers;
}

/// In the plane when the point asked for has no height.
double distance_m(const PlanPoint& position, const PlanPoint& asked) {
  const double along_z = asked.z ? position.z.value_or(*asked.z) - *asked.z : 0.0;
  return std::hypot((position.xy - asked.xy).norm(), along_z);
}

}  // namespace

Result<MapAnswers> query_map(const MapArchive& archive, const MapQuery& query) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer layer, archive_layer(archive, query.layer));
  if (layer.content->is_flat()) HYPERMAP_TRY(check_flat(query));
  return answers_of(archive, layer, query);
}

std::string nearest_layer(const MapArchive& archive) {
  const Layer* layer = find_layer_of<SemanticLayer>(archive, kSemanticLayer);
  const bool has_shapes =
      layer != nullptr && !layer->content.as<SemanticLayer>()->objects().empty();
  const bool asks_shapes = archive.objects.empty() && has_shapes;
  return asks_shapes ? layer->info.name : std::string(kObjectsLayer);
}

Result<MapAnswers> query_nearest(const MapArchive& archive,
                                 const MapQuery& query,
                                 std::size_t count) {
  if (!query.at) return fail(ErrorCode::kInvalidArgument, "is needed", "at");
  HYPERMAP_ASSIGN_OR_RETURN(const Layer layer, archive_layer(archive, nearest_layer(archive)));
  if (layer.content->is_flat() && query.at->z) {
    return fail(ErrorCode::kInvalidArgument, "takes 2 numbers on a 2D layer", "at");
  }
  MapQuery conditions = query;
  conditions.at.reset();
  HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, answers_of(archive, layer, conditions));
  if (answers.found.empty()) {
    return fail(ErrorCode::kNotFound, "no object" + unmet_conditions_of(query, archive));
  }
  for (MapAnswer& one : answers.found) one.distance_m = distance_m(one.position, *query.at);
  std::ranges::stable_sort(answers.found, {}, &MapAnswer::distance_m);
  if (answers.found.size() > count) answers.found.resize(count);
  return answers;
}

}  // namespace hypermap

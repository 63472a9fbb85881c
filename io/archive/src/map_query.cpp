// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_query.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/vocabulary/asked_names.hpp"
#include "hypermap/io/archive/asked_of_map.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/projection/layers/hypermap_query.hpp"

#include <cstdint>
#include <set>
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

std::vector<ObjectId> ids_of(const MapAnswers& answers) {
  std::vector<ObjectId> ids;
  ids.reserve(answers.found.size());
  for (const MapAnswer& one : answers.found) {
    ids.push_back(ObjectId{static_cast<std::uint32_t>(one.id)});
  }
  return ids;
}

/// The names that the text asks for. Errors: those of asked_of_map, of the member `text`.
Result<std::optional<NameSelection>> asked_text(const MapArchive& archive, const MapQuery& query) {
  if (!query.text) return std::optional<NameSelection>();
  auto names = asked_of_map(archive, *query.text);
  if (names) return std::optional(std::move(*names));
  names.error().field = "string";
  return Unexpected(std::move(names).error());
}

/// What no object fulfils, for people.
std::string conditions_of(const MapQuery& query, const MapArchive& archive) {
  std::string text;
  if (query.text) text += " of class '" + printable(*query.text) + "'";
  if (query.value) text += " with id " + std::to_string(*query.value);
  if (query.area) text += " in the area";
  if (!query.text || is_class_of_map(archive, *query.text)) return text;
  const auto names = asked_of_map(archive, *query.text);
  const bool is_plain = names && names->contains(*query.text);
  if (is_plain && !archive.vocabulary.knows(*query.text)) {
    return text + did_you_mean(*query.text, archive.classes.names());
  }
  return text + ": " + nothing_asked(*query.text, archive.classes.names(), archive.vocabulary);
}

/// A frame is known when a layer or a transform has it.
Result<void> check_frame(const MapArchive& archive, const std::string& frame_id) {
  if (frame_id.empty()) return {};
  std::set<std::string> known;
  for (const Layer& layer : archive_layers(archive)) known.insert(layer.info.frame_id);
  for (const FrameTransform& transform : archive.hypermap.frames().transforms()) {
    known.insert(transform.frame_id);
    known.insert(transform.child_frame_id);
  }
  if (known.contains(frame_id)) return {};
  const std::vector<std::string> names(known.begin(), known.end());
  return fail(ErrorCode::kNotFound, nothing_named("frame", frame_id, names), "frame_id");
}

}  // namespace

Result<MapAnswers> query_map(const MapArchive& archive, const MapQuery& query) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer layer, archive_layer(archive, query.layer));
  if (layer.content->is_flat()) HYPERMAP_TRY(check_flat(query));
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

Result<MapAnswers> query_nearest(const MapArchive& archive, const MapQuery& query) {
  if (!query.at) return fail(ErrorCode::kInvalidArgument, "is needed", "at");
  MapQuery conditions = query;
  conditions.layer = kObjectsLayer;
  conditions.at.reset();
  HYPERMAP_ASSIGN_OR_RETURN(MapAnswers answers, query_map(archive, conditions));
  HYPERMAP_ASSIGN_OR_RETURN(const Layer layer, archive_layer(archive, conditions.layer));
  HYPERMAP_ASSIGN_OR_RETURN(
      const Eigen::Isometry2d layer_from_query,
      archive.hypermap.frames().to_from(layer.info.frame_id, answers.frame_id));
  const PlanPoint point{.xy = layer_from_query * query.at->xy, .z = query.at->z};
  const auto nearest =
      nearest_object(archive.objects, archive.classes, {.among = ids_of(answers)}, point);
  if (!nearest) return fail(ErrorCode::kNotFound, "no object" + conditions_of(query, archive));
  std::erase_if(answers.found, [&](const MapAnswer& one) { return one.id != nearest->value; });
  return answers;
}

}  // namespace hypermap

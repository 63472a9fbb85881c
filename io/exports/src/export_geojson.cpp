// SPDX-License-Identifier: BSD-3-Clause
#include "export_parts.hpp"
#include "exported_objects.hpp"
#include "hypermap/core/completion/completion.hpp"
#include "hypermap/io/archive/object_completion.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/codec/atomic_file.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using Json = nlohmann::ordered_json;

Json ring_json(const Ring& ring) {
  Json points = Json::array();
  for (const Eigen::Vector2d& point : ring) points.push_back({point.x(), point.y()});
  points.push_back({ring.front().x(), ring.front().y()});
  return points;
}

Json polygon_json(const Polygon& polygon) {
  Json rings = Json::array({ring_json(polygon.outer)});
  for (const Ring& hole : polygon.holes) rings.push_back(ring_json(hole));
  return rings;
}

Json geometry_json(const std::vector<Polygon>& parts) {
  if (parts.size() == 1) {
    return {{"type", "Polygon"}, {"coordinates", polygon_json(parts.front())}};
  }
  Json polygons = Json::array();
  for (const Polygon& part : parts) polygons.push_back(polygon_json(part));
  return {{"type", "MultiPolygon"}, {"coordinates", std::move(polygons)}};
}

Json numbers_json(const Eigen::Vector3d& point) {
  return {point.x(), point.y(), point.z()};
}

Json box_json(const Box& box) {
  const Eigen::Vector3d& low = box.min_in_map;
  const Eigen::Vector3d& high = box.max_in_map;
  return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
}

using Guesses = std::map<ObjectId, Box>;

/// What an object rests on, and by kind the ids of those that it is on, in, under, beside, part of.
void add_relations(Json& properties, ObjectId id, const RelationGraph& graph) {
  const auto support = support_of(graph, id);
  if (!support) return;
  properties["support"] = name_of(support->kind);
  for (const Relation& relation : relations_of(graph, id)) {
    const ObjectId other = relation.subject == id ? relation.object : relation.subject;
    properties[std::string(key_of(relation.kind))].push_back(other.value);
  }
}

/// What is said of 3D objects besides what they are.
struct ObjectRemarks {
  Guesses guesses;
  RelationGraph graph;
};

/// `object3d` is what the shape stands for; null when the map does not know.
Json feature_json(const SemanticObject& object,
                  const Object* object3d,
                  const ObjectRemarks& remarks) {
  Json properties{{"name", object.name}};
  if (const auto confidence = confidence_of(object)) properties["confidence"] = *confidence;
  if (!object.tags.empty()) properties["tags"] = object.tags;
  Json feature{{"type", "Feature"}, {"id", object.id}};
  if (object3d != nullptr) {
    const Box& box = object3d->box;
    properties["size_m"] = numbers_json(box.extent());
    properties["height_m"] = box.extent().z();
    properties["seen_share"] = seen_share(*object3d);
    add_relations(properties, object3d->id, remarks.graph);
    if (const auto guess = remarks.guesses.find(object3d->id); guess != remarks.guesses.end()) {
      properties["completed_box"] = {{"bbox", box_json(guess->second)}, {"guess", true}};
    }
    feature["bbox"] = box_json(box);
  }
  feature["properties"] = std::move(properties);
  feature["geometry"] = geometry_json(object.parts);
  return feature;
}

}  // namespace

Result<WrittenFiles> export_geojson(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const Layer* layer,
                            wanted_layer<SemanticLayer>(archive, request, kSemanticLayerClass));
  const SemanticLayer& semantic = *layer->content.as<SemanticLayer>();
  HYPERMAP_ASSIGN_OR_RETURN(const auto shapes, exported_shapes(archive, semantic, request.classes));
  const ObjectRemarks remarks{.guesses = request.complete ? completed_boxes(archive) : Guesses(),
                              .graph = archive_relations(archive, request.rules)};
  Json features = Json::array();
  for (const SemanticObject* shape : shapes) {
    features.push_back(feature_json(*shape, object_of(*shape, *layer, archive), remarks));
  }
  if (features.empty()) return WrittenFiles{};
  const Json document{{"type", "FeatureCollection"},
                      {"name", layer->info.name},
                      {"frame_id", layer->info.frame_id},
                      {"unit", "metre"},
                      {"features", std::move(features)}};
  HYPERMAP_TRY(write_file_atomically(
      request.output, document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"));
  return WrittenFiles{request.output};
}

}  // namespace hypermap

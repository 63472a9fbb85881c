// SPDX-License-Identifier: BSD-3-Clause
#include "dot_text.hpp"
#include "export_parts.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/places/relation_text.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "output_ending.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace hypermap {
namespace {

using Json = nlohmann::ordered_json;

/// Relations of the objects of the classes asked for, and the objects at their ends.
struct WrittenGraph {
  const MapArchive& archive;
  RelationGraph graph;
};

Result<WrittenGraph> written_graph(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto wanted, wanted_classes(archive, request));
  WrittenGraph written{archive, archive_relations(archive, request.rules)};
  if (!wanted) return written;
  std::set<ObjectId> ids;
  for (const ObjectSupport& one : written.graph.supports) {
    const auto best = best_class(archive.objects.at(one.id));
    if (best && wanted->contains(best->id)) ids.insert(one.id);
  }
  std::erase_if(written.graph.relations, [&](const Relation& relation) {
    return !ids.contains(relation.subject) && !ids.contains(relation.object);
  });
  for (const Relation& relation : written.graph.relations) {
    ids.insert({relation.subject, relation.object});
  }
  std::erase_if(written.graph.supports,
                [&](const ObjectSupport& one) { return !ids.contains(one.id); });
  return written;
}

Eigen::Vector2d place_of(const WrittenGraph& written, ObjectId id) {
  return written.archive.objects.at(id).centroid_in_map.head<2>();
}

std::string node_text(const WrittenGraph& written, ObjectId id) {
  const Eigen::Vector2d at = place_of(written, id);
  return "  " + std::to_string(id.value) + " [label=" + dot_string(called(written.archive, id)) +
         ", pos=\"" + number_text(at.x()) + "," + number_text(at.y()) + "!\"];\n";
}

/// Beside has no direction, and moves no node to another rank.
std::string edge_text(const Relation& relation) {
  std::string text = "  " + std::to_string(relation.subject.value) + " -> " +
                     std::to_string(relation.object.value) +
                     " [label=" + dot_string(name_of(relation.kind));
  if (relation.kind == RelationKind::kBeside) text += ", dir=none, style=dashed, constraint=false";
  for (const auto& [name, value] : measures_of(relation.evidence)) {
    text += ", " + std::string(name) + "=" + number_text(value);
  }
  return text + "];\n";
}

std::string relations_dot(const WrittenGraph& written) {
  std::string text = "digraph relations {\n  rankdir=BT;\n";
  const auto on_floor = [](const ObjectSupport& one) { return one.kind == SupportKind::kFloor; };
  const auto& supports = written.graph.supports;
  for (const ObjectSupport& one : supports) text += node_text(written, one.id);
  if (std::ranges::any_of(supports, on_floor)) text += "  floor [shape=box];\n";
  for (const ObjectSupport& one : supports) {
    if (on_floor(one)) text += "  " + std::to_string(one.id.value) + " -> floor [label=\"on\"];\n";
  }
  for (const Relation& relation : written.graph.relations) text += edge_text(relation);
  return text + "}\n";
}

Json place_json(const WrittenGraph& written, ObjectId id) {
  const Eigen::Vector2d at = place_of(written, id);
  return {at.x(), at.y()};
}

Json node_json(const WrittenGraph& written, const ObjectSupport& one) {
  const auto naming = [&](ObjectId id) { return called(written.archive, id); };
  Json properties{{"name", naming(one.id)}, {"support", name_of(one.kind)}};
  if (one.by != kNoObject) properties["supported_by"] = one.by.value;
  properties["sentence"] = sentence_of(written.graph, one.id, naming);
  return {{"type", "Feature"},
          {"id", one.id.value},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "Point"}, {"coordinates", place_json(written, one.id)}}}};
}

Json edge_json(const WrittenGraph& written, const Relation& relation) {
  Json properties{{"relation", key_of(relation.kind)},
                  {"from", relation.subject.value},
                  {"to", relation.object.value}};
  for (const auto& [name, value] : measures_of(relation.evidence)) {
    properties[std::string(name)] = value;
  }
  properties["source"] = name_of(relation.evidence.source);
  Json line =
      Json::array({place_json(written, relation.subject), place_json(written, relation.object)});
  return {{"type", "Feature"},
          {"properties", std::move(properties)},
          {"geometry", {{"type", "LineString"}, {"coordinates", std::move(line)}}}};
}

std::string relations_geojson(const WrittenGraph& written) {
  Json features = Json::array();
  for (const ObjectSupport& one : written.graph.supports)
    features.push_back(node_json(written, one));
  for (const Relation& relation : written.graph.relations) {
    features.push_back(edge_json(written, relation));
  }
  const Json document{{"type", "FeatureCollection"},
                      {"name", "relations"},
                      {"frame_id", shown_frame_id(written.archive)},
                      {"unit", "metre"},
                      {"features", std::move(features)}};
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

Result<WrittenFiles> export_relations(const MapArchive& archive, const ExportRequest& request) {
  HYPERMAP_ASSIGN_OR_RETURN(const WrittenGraph written, written_graph(archive, request));
  if (written.graph.supports.empty()) return WrittenFiles{};
  HYPERMAP_TRY(write_file_atomically(
      request.output,
      has_ending(request, ".dot") ? relations_dot(written) : relations_geojson(written)));
  return WrittenFiles{request.output};
}

}  // namespace hypermap

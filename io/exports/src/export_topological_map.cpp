// SPDX-License-Identifier: BSD-3-Clause
#include "dot_text.hpp"
#include "export_parts.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/places/object_vertices.hpp"
#include "hypermap/core/places/vocabulary_rules.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/map_places.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/archive/vertex_places.hpp"
#include "hypermap/io/codec/atomic_file.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {
namespace {

/// What stands at each vertex, in words: confirmed objects, ascending.
std::vector<std::string> names_at_vertices(const MapArchive& archive) {
  const TopologicalMap& map = *archive.topological_map;
  std::vector<std::string> names(map.vertices().size());
  for (const ObjectId id : confirmed_ids_of(archive)) {
    const auto vertex = vertex_of(map, archive.objects.at(id));
    if (!vertex) continue;
    std::string& text = names[vertex->value];
    text += (text.empty() ? "" : ", ") + called(archive, id);
  }
  return names;
}

/// By vertex; empty where none is known. Errors: those of map_places but kNotFound.
Result<std::vector<VertexPlace>> places_at_vertices(const MapArchive& archive,
                                                    const std::optional<PlaceRules>& rules) {
  if (!rules) return std::vector<VertexPlace>();
  HYPERMAP_ASSIGN_OR_RETURN(
      const auto classifier,
      BelongingsClassifier::create(with_vocabulary(*rules, archive.vocabulary)));
  const auto rooms = map_places(archive, classifier);
  if (!rooms && rooms.error().code == ErrorCode::kNotFound) return std::vector<VertexPlace>();
  if (!rooms) return Unexpected(rooms.error());
  return vertex_places(archive, *rooms, classifier);
}

/// "", or the room and the class of the place as attributes.
std::string place_attributes(const VertexPlace& vertex) {
  std::string text;
  if (vertex.room != kNoRoom) text += ", room=" + std::to_string(vertex.room);
  if (vertex.place) text += ", place=" + dot_string(*vertex.place);
  return text;
}

std::string topological_map_dot(const MapArchive& archive, std::span<const VertexPlace> places) {
  const TopologicalMap& map = *archive.topological_map;
  const std::vector<std::string> names = names_at_vertices(archive);
  std::string text = "graph topological_map {\n";
  for (std::uint32_t i = 0; i < map.vertices().size(); ++i) {
    const auto& [at, kind] = map.vertices()[i];
    std::string label = std::to_string(i);
    if (!names[i].empty()) label += ": " + names[i];
    if (!places.empty() && places[i].place) label += " (" + *places[i].place + ")";
    text += "  " + std::to_string(i) + " [label=" + dot_string(label) + ", pos=\"" +
            number_text(at.x()) + "," + number_text(at.y()) + "!\"";
    if (kind == VertexKind::kSupport) text += ", style=dashed";
    if (!places.empty()) text += place_attributes(places[i]);
    text += "];\n";
  }
  for (const auto& [from, to] : map.edges()) {
    text += "  " + std::to_string(from.value) + " -- " + std::to_string(to.value) +
            " [len=" + number_text(map.distance_m(from, to)) + "];\n";
  }
  return text + "}\n";
}

}  // namespace

Result<WrittenFiles> export_topological_map(const MapArchive& archive,
                                            const ExportRequest& request) {
  if (!archive.topological_map || archive.topological_map->vertices().empty()) {
    return WrittenFiles{};
  }
  HYPERMAP_ASSIGN_OR_RETURN(const auto places, places_at_vertices(archive, request.place_rules));
  HYPERMAP_TRY(write_file_atomically(request.output, topological_map_dot(archive, places)));
  return WrittenFiles{request.output};
}

}  // namespace hypermap

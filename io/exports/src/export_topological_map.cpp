// SPDX-License-Identifier: BSD-3-Clause
#include "dot_text.hpp"
#include "export_parts.hpp"
#include "hypermap/core/base/number_text.hpp"
#include "hypermap/core/places/object_vertices.hpp"
#include "hypermap/io/archive/map_layers.hpp"
#include "hypermap/io/archive/object_relations.hpp"
#include "hypermap/io/codec/atomic_file.hpp"

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

std::string topological_map_dot(const MapArchive& archive) {
  const TopologicalMap& map = *archive.topological_map;
  const std::vector<std::string> names = names_at_vertices(archive);
  std::string text = "graph topological_map {\n";
  for (std::uint32_t i = 0; i < map.vertices().size(); ++i) {
    const auto& [at, kind] = map.vertices()[i];
    std::string label = std::to_string(i);
    if (!names[i].empty()) label += ": " + names[i];
    text += "  " + std::to_string(i) + " [label=" + dot_string(label) + ", pos=\"" +
            number_text(at.x()) + "," + number_text(at.y()) + "!\"";
    if (kind == VertexKind::kSupport) text += ", style=dashed";
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
  const std::string name = request.output.string();
  if (!name.ends_with(".dot")) {
    return fail(
        ErrorCode::kInvalidArgument, "must end in .dot, is '" + printable(name) + "'", "--output");
  }
  if (!archive.topological_map || archive.topological_map->vertices().empty()) {
    return WrittenFiles{};
  }
  HYPERMAP_TRY(write_file_atomically(request.output, topological_map_dot(archive)));
  return WrittenFiles{request.output};
}

}  // namespace hypermap

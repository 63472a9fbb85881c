// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/merged_topological_map.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {
namespace {

std::string text_of(const TopologicalMapOptions& options) {
  return "vertices " + number_text(options.vertex_distance_m) + " m, edges " +
         number_text(options.edge_factor) + " of that";
}

/// The edge from a vertex of the added map, which is called `id` now, to the nearest of the other.
std::optional<TopologicalEdge> edge_to(const TopologicalMap& map,
                                       const TopologicalVertex& vertex,
                                       VertexId id,
                                       const IsWayFree& is_free) {
  if (vertex.kind != VertexKind::kPath) return std::nullopt;
  const auto nearest = map.nearest_path_vertex(vertex.position_in_map, map.max_edge_m());
  if (!nearest) return std::nullopt;
  const Eigen::Vector3d& there = map.vertices()[nearest->value].position_in_map;
  if (is_free && !is_free(vertex.position_in_map, there)) return std::nullopt;
  return TopologicalEdge{*nearest, id};
}

}  // namespace

Result<TopologicalMap> merged(const TopologicalMap& map,
                              const TopologicalMap& added,
                              const IsWayFree& is_free) {
  if (map.options() != added.options()) {
    return fail(ErrorCode::kInvalidArgument,
                "has other options (" + text_of(added.options()) + ") than the other map (" +
                    text_of(map.options()) + ")",
                "places");
  }
  const auto offset = static_cast<std::uint32_t>(map.vertices().size());
  const auto later = [&](VertexId id) { return VertexId{id.value + offset}; };
  std::vector<TopologicalVertex> vertices = map.vertices();
  std::vector<TopologicalEdge> edges = map.edges();
  for (std::uint32_t i = 0; i < added.vertices().size(); ++i) {
    const TopologicalVertex& vertex = added.vertices()[i];
    vertices.push_back(vertex);
    if (const auto edge = edge_to(map, vertex, later(VertexId{i}), is_free)) edges.push_back(*edge);
  }
  for (const TopologicalEdge& edge : added.edges()) {
    edges.push_back({later(edge.from), later(edge.to)});
  }
  std::ranges::sort(edges);
  std::optional<TopologicalWalk> walk = map.walk();
  if (added.walk()) {
    walk = TopologicalWalk{later(added.walk()->at), added.walk()->position_in_map};
  }
  return TopologicalMap::create(map.options(), vertices, edges, walk);
}

}  // namespace hypermap

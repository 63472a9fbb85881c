// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/topological_map_json.hpp"

#include "hypermap/core/base/caught.hpp"
#include "hypermap/io/codec/json_fields.hpp"
#include "hypermap/io/codec/json_text.hpp"
#include "text_lines.hpp"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr std::string_view kTopologyFormatName = "hypermap-topological-map";

std::string json_of_position(const Eigen::Vector3d& at) {
  return "[" + json_number(at.x()) + "," + json_number(at.y()) + "," + json_number(at.z()) + "]";
}

std::string json_of_walk(const std::optional<TopologicalWalk>& walk) {
  if (!walk) return "null";
  return json_object({{"at", std::to_string(walk->at.value)},
                      {"position", json_of_position(walk->position_in_map)}});
}

std::string json_line_of_vertex(const TopologicalMap& map, VertexId id) {
  const TopologicalVertex& vertex = map.vertices()[id.value];
  std::vector<VertexId> before;
  for (const VertexId other : map.neighbours(id)) {
    if (other < id) before.push_back(other);
  }
  const auto number = [](VertexId other) { return std::to_string(other.value); };
  return json_object({{"kind", json_quoted(name_of(vertex.kind))},
                      {"position", json_of_position(vertex.position_in_map)},
                      {"joined", json_array(before, number)}}) +
         "\n";
}

struct TopologyHead {
  TopologicalMapOptions options;
  std::size_t num_vertices = 0;
  std::optional<TopologicalWalk> walk;
};

Result<Eigen::Vector3d> position_at(const JsonNode& object) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode position, object.require("position"));
  return vector_of<3>(position);
}

Result<std::optional<TopologicalWalk>> parse_walk(const JsonNode& node) {
  if (node.kind() == JsonKind::kNull) return std::optional<TopologicalWalk>();
  HYPERMAP_TRY(expect_keys(node, {"at", "position"}));
  TopologicalWalk walk;
  HYPERMAP_ASSIGN_OR_RETURN(walk.at.value, integer_at<std::uint32_t>(node, "at"));
  HYPERMAP_ASSIGN_OR_RETURN(walk.position_in_map, position_at(node));
  return std::optional(walk);
}

Result<TopologyHead> parse_topology_head(const JsonNode& node, const TopologicalMapLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto version, integer_at<std::int32_t>(node, "version"));
  if (version > kTopologicalMapVersion) {
    return node.error(ErrorCode::kUnsupported,
                      "written by a newer version " + std::to_string(version) +
                          ", the newest that is read here is " +
                          std::to_string(kTopologicalMapVersion));
  }
  HYPERMAP_TRY(expect_keys(
      node, {"format", "version", "vertex_distance_m", "edge_factor", "num_vertices", "walk"}));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode format, node.require("format"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view format_name, format.string());
  if (format_name != kTopologyFormatName || version != kTopologicalMapVersion) {
    return format.error(ErrorCode::kMalformedFile,
                        "expected hypermap-topological-map of version 1");
  }
  TopologyHead head;
  HYPERMAP_ASSIGN_OR_RETURN(head.options.vertex_distance_m, number_at(node, "vertex_distance_m"));
  HYPERMAP_ASSIGN_OR_RETURN(head.options.edge_factor, number_at(node, "edge_factor"));
  HYPERMAP_ASSIGN_OR_RETURN(head.num_vertices, integer_at<std::uint32_t>(node, "num_vertices"));
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode walk, node.require("walk"));
  HYPERMAP_ASSIGN_OR_RETURN(head.walk, parse_walk(walk));
  if (head.num_vertices > limits.max_vertices) {
    return node.error(ErrorCode::kLimit,
                      std::to_string(head.num_vertices) + " vertices, the limit is " +
                          std::to_string(limits.max_vertices));
  }
  return head;
}

Result<TopologicalVertex> parse_vertex(const JsonNode& node) {
  HYPERMAP_TRY(expect_keys(node, {"kind", "position", "joined"}));
  TopologicalVertex vertex;
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode kind, node.require("kind"));
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view name, kind.string());
  const auto known = std::ranges::find(kVertexKinds, name, [](VertexKind k) { return name_of(k); });
  if (known == kVertexKinds.end()) {
    return kind.error(ErrorCode::kMalformedFile, "must be path or support");
  }
  vertex.kind = *known;
  HYPERMAP_ASSIGN_OR_RETURN(vertex.position_in_map, position_at(node));
  return vertex;
}

/// Edges to vertices before `id`.
Result<void> append_edges(const JsonNode& node,
                          std::uint32_t id,
                          std::vector<TopologicalEdge>& edges) {
  HYPERMAP_ASSIGN_OR_RETURN(const JsonNode list, node.require("joined"));
  HYPERMAP_ASSIGN_OR_RETURN(const auto joined, list_of(list, integer_of<std::uint32_t>));
  for (std::size_t i = 0; i < joined.size(); ++i) {
    if (joined[i] >= id || (i > 0 && joined[i] <= joined[i - 1])) {
      return list.at(i).error(ErrorCode::kMalformedFile,
                              "must name vertices before " + std::to_string(id) + ", ascending");
    }
    edges.push_back({VertexId{joined[i]}, VertexId{id}});
  }
  return {};
}

Result<JsonDocument> next_line_of_topology(TextLines& lines,
                                           const std::string& name,
                                           const TopologicalMapLimits& limits) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string_view line, lines.take());
  return JsonDocument::parse(line, name, {.max_bytes = limits.max_line_bytes}, lines.number());
}

Result<TopologicalMap> parse_topology_lines(std::string_view bytes,
                                            const std::string& name,
                                            const TopologicalMapLimits& limits,
                                            const LoadBudget& budget) {
  TextLines lines(bytes);
  HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument first, next_line_of_topology(lines, name, limits));
  HYPERMAP_ASSIGN_OR_RETURN(const TopologyHead head, parse_topology_head(first.root(), limits));
  std::vector<TopologicalVertex> vertices;
  std::vector<TopologicalEdge> edges;
  while (!lines.done() && vertices.size() < head.num_vertices) {
    HYPERMAP_TRY(budget.check_stop());
    HYPERMAP_ASSIGN_OR_RETURN(const JsonDocument line, next_line_of_topology(lines, name, limits));
    HYPERMAP_TRY(append_edges(line.root(), static_cast<std::uint32_t>(vertices.size()), edges));
    HYPERMAP_ASSIGN_OR_RETURN(vertices.emplace_back(), parse_vertex(line.root()));
  }
  if (!lines.done() || vertices.size() != head.num_vertices) {
    return fail(ErrorCode::kMalformedFile,
                "says " + std::to_string(head.num_vertices) + " vertices, there are " +
                    (lines.done() ? "only " + std::to_string(vertices.size()) : "more"),
                "num_vertices");
  }
  std::ranges::sort(edges);
  return validated(first.root(), TopologicalMap::create(head.options, vertices, edges, head.walk));
}

}  // namespace

Result<std::string> write_topological_map(const TopologicalMap& map,
                                          const TopologicalMapLimits& limits) {
  const std::size_t num_vertices = map.vertices().size();
  if (num_vertices > limits.max_vertices) {
    return fail(ErrorCode::kLimit,
                std::to_string(num_vertices) + " vertices, the limit is " +
                    std::to_string(limits.max_vertices),
                "topological map");
  }
  std::string text =
      json_object({{"format", json_quoted(kTopologyFormatName)},
                   {"version", std::to_string(kTopologicalMapVersion)},
                   {"vertex_distance_m", json_number(map.options().vertex_distance_m)},
                   {"edge_factor", json_number(map.options().edge_factor)},
                   {"num_vertices", std::to_string(num_vertices)},
                   {"walk", json_of_walk(map.walk())}});
  text += '\n';
  for (std::uint32_t i = 0; i < num_vertices; ++i) text += json_line_of_vertex(map, VertexId{i});
  return text;
}

Result<TopologicalMap> parse_topological_map(std::string_view bytes,
                                             const SourceName& source,
                                             const TopologicalMapLimits& limits,
                                             const LoadBudget& budget) try {
  auto map = parse_topology_lines(bytes, source.file, limits, budget);
  if (!map) return tl::make_unexpected(with_source(std::move(map).error(), source));
  return map;
} catch (const std::exception& exception) {
  return caught(exception, ErrorCode::kMalformedFile, "the topological map");
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/topological_map_layer.hpp"

#include "hypermap/io/archive/hypermap_config.hpp"
#include "hypermap/io/archive/topological_map_json.hpp"
#include "hypermap/projection/layers/layer_members.hpp"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr Rgb8 kTopologicalEdgeColor{40, 90, 200};
constexpr double kVertexMarkM = 0.08;  ///< From its middle to its sides.

double distance_to_m(const PlanPoint& point, const Eigen::Vector3d& position) {
  const double height_m = point.z ? *point.z - position.z() : 0.0;
  return std::hypot((position.head<2>() - point.xy).norm(), height_m);
}

/// The vertex that a point belongs to.
std::optional<VertexId> vertex_at(const TopologicalMap& map, const PlanPoint& point) {
  std::optional<VertexId> nearest;
  double nearest_m = map.options().vertex_distance_m;
  for (std::uint32_t i = 0; i < map.vertices().size(); ++i) {
    const double away_m = distance_to_m(point, map.vertices()[i].position_in_map);
    if (away_m >= nearest_m) continue;
    nearest = VertexId{i};
    nearest_m = away_m;
  }
  return nearest;
}

DrawnLine line(std::vector<Eigen::Vector2d> points) {
  return {.points = std::move(points), .color = kTopologicalEdgeColor};
}

/// A path vertex is a square, a support vertex a cross.
std::vector<DrawnLine> mark_of(const TopologicalVertex& vertex) {
  const Eigen::Vector2d at = vertex.position_in_map.head<2>();
  const Eigen::Vector2d up(kVertexMarkM, kVertexMarkM);
  const Eigen::Vector2d down(kVertexMarkM, -kVertexMarkM);
  if (vertex.kind == VertexKind::kPath)
    return {line({at - up, at + down, at + up, at - down, at - up})};
  return {line({at - up, at + up}), line({at - down, at + down})};
}

}  // namespace

std::string_view TopologicalMapLayer::class_name() const {
  return kTopologicalMapFormat;
}

LayerStatistics TopologicalMapLayer::statistics() const {
  LayerStatistics statistics{.num_values = map_.vertices().size()};
  Eigen::AlignedBox3d box;
  for (const TopologicalVertex& vertex : map_.vertices()) box.extend(vertex.position_in_map);
  if (!box.isEmpty()) statistics.bounds = box;
  return statistics;
}

Result<std::vector<LayerAnswer>> TopologicalMapLayer::query(const LayerQuery& query) const {
  std::vector<LayerAnswer> answers;
  const auto at = query.at ? vertex_at(map_, *query.at) : std::nullopt;
  if (query.at && !at) return answers;
  for (std::uint32_t i = 0; i < map_.vertices().size(); ++i) {
    const auto& [position, kind] = map_.vertices()[i];
    if (at && at->value != i) continue;
    if (query.area && !contains(*query.area, position.head<2>())) continue;
    LayerAnswer answer{.id = i,
                       .name = std::string(name_of(kind)),
                       .value = i,
                       .position = position.head<2>(),
                       .z_m = position.z()};
    if (has_representation(answer, query)) answers.push_back(std::move(answer));
  }
  return answers;
}

std::vector<LayerPrimitive> TopologicalMapLayer::draw() const {
  std::vector<LayerPrimitive> drawn;
  for (const auto& [from, to] : map_.edges()) {
    drawn.emplace_back(line({map_.vertices()[from.value].position_in_map.head<2>(),
                             map_.vertices()[to.value].position_in_map.head<2>()}));
  }
  for (const TopologicalVertex& vertex : map_.vertices()) {
    for (DrawnLine& stroke : mark_of(vertex)) drawn.emplace_back(std::move(stroke));
  }
  return drawn;
}

Result<void> TopologicalMapLayer::save(LayerWriter& writer) const {
  HYPERMAP_ASSIGN_OR_RETURN(std::string bytes, write_topological_map(map_));
  return writer.bytes("", std::move(bytes));
}

bool TopologicalMapLayer::equals(const MapLayer& other) const {
  return is_same_layer(*this, other);
}

}  // namespace hypermap

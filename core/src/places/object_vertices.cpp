// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/object_vertices.hpp"

#include "hypermap/core/places/topological_routes.hpp"

#include <algorithm>

namespace hypermap {

std::optional<VertexId> vertex_of(const TopologicalMap& map, const Object& object) {
  return map.nearest(object.centroid_in_map);
}

std::vector<ObjectId> objects_near(const TopologicalMap& map,
                                   const ObjectMap& objects,
                                   VertexId from,
                                   int num_layers) {
  const std::vector<VertexId> vertices = neighbourhood(map, from, num_layers);
  const double reach_m = map.options().vertex_distance_m;
  std::vector<ObjectId> found;
  for (const VertexId id : vertices) {
    const Eigen::Vector3d& at = map.vertices()[id.value].position_in_map;
    const auto around = objects.query(Box{at.array() - reach_m, at.array() + reach_m});
    found.insert(found.end(), around.begin(), around.end());
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::erase_if(found, [&](ObjectId id) {
    const auto vertex = vertex_of(map, objects.at(id));
    return !std::ranges::binary_search(vertices, *vertex);
  });
  return found;
}

std::optional<VertexId> related_vertex(const TopologicalMap& map,
                                       const Eigen::Vector3d& position_in_map) {
  const double reach_m = 2.0 * map.options().vertex_distance_m;
  const auto on_way = map.nearest_path_vertex(position_in_map, reach_m);
  return on_way ? on_way : map.nearest(position_in_map);
}

VertexNeighbourhood::VertexNeighbourhood(const TopologicalMap& map,
                                         const Eigen::Vector3d& sensor_in_map,
                                         int num_layers)
    : map_(&map),
      vertices_(neighbourhood(map, related_vertex(map, sensor_in_map).value(), num_layers)) {}

bool VertexNeighbourhood::contains(const Eigen::Vector3d& centroid_in_map) const {
  return std::ranges::binary_search(vertices_, related_vertex(*map_, centroid_in_map).value());
}

}  // namespace hypermap

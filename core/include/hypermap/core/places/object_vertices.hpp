// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which vertex of a topological map an object belongs to, and which objects are near by edges.
///
/// Source: [smap] 3.5.1 (an object is related to one vertex), 3.5.4 (it moves to a nearer one).
/// Deviation: nothing of this is stored: an object is at its nearest vertex at any time.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/core/places/topological_map.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace hypermap {

/// The vertex nearest to the object's centroid; none in an empty map. Frame: Map.
[[nodiscard]] std::optional<VertexId> vertex_of(const TopologicalMap& map, const Object& object);

/// Objects at the vertices that at most `num_layers` edges lie between `from` and, ascending.
///
/// Requires: a vertex of the map; num_layers >= 0. Boundary: an object that is nowhere nearer than
/// V_d to a vertex, as rule 2 wants it, may be left out.
/// Cost: of the vertices found and the objects around them, not of all.
[[nodiscard]] std::vector<ObjectId> objects_near(const TopologicalMap& map,
                                                 const ObjectMap& objects,
                                                 VertexId from,
                                                 int num_layers);

/// The vertex that [smap] relates an object or the robot at a position to: the nearest path vertex
/// where one is nearer than 2 V_d, else the nearest vertex; none in an empty map. Frame: Map.
///
/// Source: [smap] 3.5.1: support vertices are for what is farther than 2 V_d from a vertex.
/// Deviation: this map makes them from V_d on, so that rule 2 holds. They hang in rows of their own
/// from the way, and layers counted over them lead from the sensor along the way to where a row
/// begins and back beside it. Measured: docs/RESULTS.md, "Preset `smap` against `default`".
[[nodiscard]] std::optional<VertexId> related_vertex(const TopologicalMap& map,
                                                     const Eigen::Vector3d& position_in_map);

/// Vertices that at most so many edges lie between the sensor's and: which objects a frame may be
/// compared with.
///
/// Source: [smap] figures 3.22 and 3.23, step 1 (3 layers for detections, 5 for absences). An
/// object moves to another vertex (step 6) by being asked where it is now.
/// Requires: the map outlives it and does not change.
class VertexNeighbourhood {
 public:
  /// Requires: a map with vertices; num_layers >= 0.
  VertexNeighbourhood(const TopologicalMap& map,
                      const Eigen::Vector3d& sensor_in_map,
                      int num_layers);

  /// Whether an object with such a centroid is related to one of the vertices. Cost: a lookup of
  /// the vertices within 2 V_d; of all where no path vertex is so near.
  [[nodiscard]] bool contains(const Eigen::Vector3d& centroid_in_map) const;

 private:
  const TopologicalMap* map_;
  std::vector<VertexId> vertices_;  ///< Ascending.
};

}  // namespace hypermap

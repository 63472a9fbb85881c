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

#include <optional>
#include <vector>

namespace hypermap {

/// The vertex nearest to the object's centroid; none in an empty map. Frame: Map.
[[nodiscard]] std::optional<VertexId> vertex_of(const TopologicalMap& map, const Object& object);

/// Objects at the vertices that at most `num_layers` edges lie between `from` and, ascending.
///
/// Source: [smap] 3.5.4, 3.5.5 (3 layers around the robot's vertex, 5 for absences).
/// Requires: a vertex of the map; num_layers >= 0. Boundary: an object that is nowhere nearer than
/// V_d to a vertex, as rule 2 wants it, may be left out.
/// Cost: of the vertices found and the objects around them, not of all.
[[nodiscard]] std::vector<ObjectId> objects_near(const TopologicalMap& map,
                                                 const ObjectMap& objects,
                                                 VertexId from,
                                                 int num_layers);

}  // namespace hypermap

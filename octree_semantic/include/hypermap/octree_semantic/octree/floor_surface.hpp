// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the floor of a map lies, by what the map shows.
#pragma once

#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <optional>

namespace hypermap {

/// The height of the lowest large level surface of these leaves of an octree: of voxels that are
/// occupied below free ones at least 2 m^2, and a tenth of what the largest level of the map has,
/// in a layer three voxels thick. Unit: metre. Frame: Map, its +z up. Source: ours.
///
/// None where there is no such surface, and where much is known to be free below it: a table top
/// whose floor was seen at the sides is none. What lies below in small parts (reflections of a
/// glossy floor, steps down) does not count. The same voxels, moved by whole ones, give the same
/// answer, moved alike, but for rounding to millimetres.
/// Requires: leaves of `octree`, which may be those of a part of it.
/// Cost: one walk over the leaves, a look above each occupied one.
[[nodiscard]] std::optional<double> floor_surface_m(const SemanticOctree& octree,
                                                    const LeafSource& leaves);

/// The height of the floor around a sensor: of the lowest surface, of no object, that twelve of the
/// lines down from its height meet first. They stand 16 cm apart within 1.9 m of it in x and y and
/// end 3 m below. Unit: metre, the middle of the voxels. Frame: Map, its +z up. Source: ours.
///
/// None before so much was measured there. Of two levels it is the lower one: a step down is the
/// floor. Boundary: it is off by half a voxel at most; the top of a table of no object is taken for
/// it while nothing lower is known. Cost: 625 rays.
[[nodiscard]] std::optional<double> floor_below_m(const SemanticOctree& octree,
                                                  const PointInMap& sensor);

}  // namespace hypermap

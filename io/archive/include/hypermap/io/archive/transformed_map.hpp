// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The same map seen from another origin: a whole archive moved by a rigid transform.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/octree_semantic/octree/transformed_octree.hpp"

namespace hypermap {

/// The map with everything in frame `map` moved. +z stays up: the transform is a turn about z and a
/// shift; a tilt below 1e-6 rad counts as none. Ids, classes and all belief stay.
///
/// Exact up to the rounding of coordinates: centroids, shapes, semantic objects, occupancy and
/// class grids (by origin and yaw), and `map_from_input` of each run, so that frames of the
/// same input still fit. For the rest:
/// - each voxel of the octree goes to one voxel, as `transformed(SemanticOctree)` says, and each
///   voted cell to one cell likewise (LatticeMotion): there and back they are the same;
/// - a box of its points becomes that of the moved points; any other one the axis-aligned box
/// around
///   the moved one: of the same size for quarter turns, else larger, and larger again each time;
/// - seen cells of true surfaces go to the cells where their centres then lie, and are not counted;
/// - bins of bearings turn by whole bins, the nearest number: exact for turns by a bin (20 degrees
///   to begin with), else off by up to half a bin, also at a quarter turn of 18 bins.
///
/// Boundary: the identity leaves all but a checkpoint as it is, also what cannot be moved. Looks at
/// blocks of voted cells follow the cells: where a motion divides a block, both parts keep the most
/// of what comes together, and blocks without cells are left out.
///
/// Layers and class grids in other frames keep their content, and their transforms to or from `map`
/// move; frames that nothing connects to `map` stay. Unknown keys and members stay as they are.
///
/// Errors: kInvalidArgument when the transform is no finite rigid motion (rotation off by more than
/// 1e-6) or tilts +z, or a polygon is none after rounding; kLimit when something would lie outside
/// the octree's volume or beyond 1e6 m; kUnsupported, each by name: a layer of another class or an
/// octree of another program in `map` (or in any frame when the map is raised or lowered, as frames
/// lie in the plane), an extension of unknown format, an octree or objects in another frame;
/// kOutOfMemory. Cost: that of the octree, and linear in the rest.
[[nodiscard]] Result<MapArchive> transformed(const MapArchive& archive,
                                             const MapFromOldMap& map_from_old);

}  // namespace hypermap

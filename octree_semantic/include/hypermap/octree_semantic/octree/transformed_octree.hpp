// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The same map seen from another origin: an octree moved by a rigid transform.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

namespace hypermap {

namespace frame {
struct OldMap {};  ///< The map before it was moved.
}  // namespace frame
using MapFromOldMap = Transform<frame::Map, frame::OldMap>;

/// A motion that leaves z up takes each voxel to one voxel, no two to the same: log-odds, classes
/// and object, free space as well. Nothing is lost or doubled, and there and back is the same map,
/// for any turn and shift; a voxel comes within 1.07 voxels in x, 0.86 in y and half a voxel in z
/// of where its centre goes, exactly there for shifts by whole voxels and turns by whole quarters
/// (x and y may change places with a quarter turn).
///
/// With a tilt a voxel of the result is what is known where its centre lay: surfaces keep their
/// place within half a voxel's diagonal, and may lose or double single voxels; exact for whole
/// quarters about axes of the grid.
///
/// Errors: kInvalidArgument when the transform is no finite rigid motion (rotation off by more than
/// 1e-6); kLimit when part of the map would lie outside the volume; kOutOfMemory.
/// Cost: linear in the voxels; with a tilt in the bricks, some ten looked at for each.
[[nodiscard]] Result<SemanticOctree> transformed(const SemanticOctree& octree,
                                                 const MapFromOldMap& map_from_old);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Parts of one map as one again.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"

#include <vector>

namespace hypermap {

/// The map that parts were cut from (`cropped`), as far as they are there: nothing is added up, as
/// each voxel, cell, shape and object is in one part. Edges of the topological map from part to
/// part (`load_tiles` knows them), and the object of voxels that lie in another part than it, stay
/// lost.
///
/// Requires: at least one part. Errors: kInvalidArgument for parts that are not of one map: other
/// classes, options of the octree, runs or lattices, or a voxel, cell, shape or object that two
/// have; kLimit; kOutOfMemory. Cost: linear.
[[nodiscard]] Result<MapArchive> joined(std::vector<MapArchive> parts);

}  // namespace hypermap

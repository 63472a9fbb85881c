// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether anything that a map knows is in the way between two places.
#pragma once

#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <Eigen/Core>

namespace hypermap {

/// Whether no occupied voxel lies between two places, their own voxels aside: what a place was
/// reached by stands in none, whatever noise says. Unknown space is free.
[[nodiscard]] bool is_way_free(const SemanticOctree& octree,
                               const Eigen::Vector3d& from_in_map,
                               const Eigen::Vector3d& to_in_map);

}  // namespace hypermap

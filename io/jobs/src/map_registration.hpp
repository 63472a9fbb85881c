// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a map lies in another one of the same place, by what both show.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/merge_job.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "hypermap/projection/grids/layer_options.hpp"

namespace hypermap {

/// The placement in which both maps say the same: x, y and yaw by their grids (`register_grids`),
/// then the height by whole voxels around the given one, for z = 0 is the floor in both.
///
/// Errors: kNotFound with the reason when the grids show too little, differ, or fit about as well
/// in several ways (`register_grids`), and when less than two thirds of the occupied voxels of
/// `moving` where both know something are within a voxel of one of `fixed` (`voxels`);
/// kInvalidArgument for a map without leaves in the band of heights; those of project_occupancy.
/// Cost: as register_grids; 27 looks at each of at most 50,000 occupied voxels, for each height.
[[nodiscard]] Result<MapPlacement> register_maps(const SemanticOctree& moving,
                                                 const SemanticOctree& fixed,
                                                 const LayerOptions& options);

}  // namespace hypermap

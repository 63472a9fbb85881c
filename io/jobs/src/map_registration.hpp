// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a map lies in another one of the same place, by what both show.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/merge_job.hpp"
#include "hypermap/projection/grids/layer_options.hpp"

namespace hypermap {

/// The placement in which both maps say the same: x, y and yaw by what each has in the band of
/// heights over its own floor (`register_grids`; floor: `known_floor_m`, else
/// where the map has it, else where the other has it), then the
/// height by whole voxels, at most 0.3 m from where the floors meet.
///
/// Errors: kNotFound with the reason when the grids show too little, differ, or fit about as well
/// in several ways (`register_grids`), and when less than two thirds of the occupied voxels of
/// `moving` where both know something are within a voxel of one of `fixed` (`voxels`);
/// kInvalidArgument for a map without leaves in the band of heights; those of project_occupancy.
/// Requires: both have an octree. Cost: as register_grids; 27 looks at each of at most 50,000
/// occupied voxels, for each height.
[[nodiscard]] Result<MapPlacement> register_maps(const MapArchive& moving,
                                                 const MapArchive& fixed,
                                                 const LayerOptions& options);

}  // namespace hypermap

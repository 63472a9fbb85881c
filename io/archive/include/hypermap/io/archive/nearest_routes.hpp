// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which object of a class a robot comes to first, and by which way.
///
/// Source: [hypermap] chapter 6 (to find the nearest object of a class). Answered by the 2D layers
/// alone: neither octree nor objects of the 3D map are needed.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/archive/map_query.hpp"
#include "hypermap/projection/grids/free_space.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

/// An object and the way to it.
struct ReachedObject {
  MapAnswer object;
  double straight_m = 0.0;  ///< From the start to its footprint, through walls. 0: upon it.
  double gap_m = 0.0;       ///< From the end of the way to its footprint.
  FreeSpaceRoute route;
};

struct ReachedObjects {
  std::string frame_id;              ///< Of all points.
  std::vector<ReachedObject> found;  ///< The shortest way first.
  /// Those beside which there is no place for the robot, ascending: nothing leads to them from
  /// anywhere.
  std::vector<std::uint64_t> out_of_reach;
};

/// The confirmed objects of the layer `semantic` (else of the first semantic layer) that fulfil all
/// conditions but `query.at`, the `count` of them to which the way from that point is shortest,
/// along the free space of the layer `occupancy` (else of the first occupancy grid). The layer that
/// `query.layer` names is not asked.
///
/// Frame: points and areas are of `query.frame_id`, else of the occupancy grid's.
/// Errors: those of validate(options); kInvalidArgument naming `at` when it is absent or has a
/// height; those of query_map; kNotFound when the map has no such layer, no object fulfils the
/// conditions, the start is outside the grid, unknown, in an obstacle or too narrow for the robot
/// (naming `at`), no object has a place beside it, or no free way leads to any; kOutOfMemory.
/// Boundary: fewer than `count` are found when no free way leads to the others.
/// Cost: that of routes_to_nearest, and places_to_reach for each object.
[[nodiscard]] Result<ReachedObjects> query_nearest_routes(const MapArchive& archive,
                                                          const MapQuery& query,
                                                          const ApproachOptions& options = {},
                                                          std::size_t count = 1);

}  // namespace hypermap

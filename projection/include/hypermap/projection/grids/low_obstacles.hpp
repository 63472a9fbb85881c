// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which obstacles of a floor are no walls, since they were looked over.
///
/// Ours. Rooms end at walls, and a wall reaches up; a desk that no detector has a word for does
/// not. What ends low is told from what was seen low only by the free space above it: the foot of a
/// wall whose upper part no camera saw stays a wall.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/geometry/map_floor.hpp"
#include "hypermap/projection/grids/occupancy_grid.hpp"

namespace hypermap {

struct OptionTable;

struct LowObstacleOptions {
  MapFloor floor = {};  ///< Over which heights are.
  /// What reaches so high is a wall or as good as one. Above tables, desks and what stands on them,
  /// below the shoulders of those who look over them.
  double wall_m = 1.4;
  /// Of the height between the top of an obstacle and `wall_m` so much must have been seen free.
  double min_free_share = 0.5;
  friend bool operator==(const LowObstacleOptions&, const LowObstacleOptions&) = default;
};

/// Errors: kInvalidArgument naming the field and its range.
[[nodiscard]] Result<void> validate(const LowObstacleOptions& options);
[[nodiscard]] const OptionTable& option_table(const LowObstacleOptions& options);

/// The grid with those occupied cells free over which nothing is occupied from `wall_m` on down to
/// a top below it, and the space between was seen free. Other cells stay as they are.
///
/// Requires: the leaves are in the frame of the grid, validate(options).
/// Boundary: a cell without an occupied leaf above it says nothing of its top and stays; a top at
/// `wall_m` is a wall's. Cost: two passes over the leaves, 8 bytes a cell.
[[nodiscard]] OccupancyGrid without_low_obstacles(OccupancyGrid grid,
                                                  const LeafSource& leaves,
                                                  const LowObstacleOptions& options = {});

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What to leave out of an image so that one can look into a room: the ceiling, and walls between
/// the eye and the room.
#pragma once

#include "hypermap/viewer_offscreen/rendering/voxel_surface.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// The lower face of the lowest level of voxels that spreads like a floor: it holds at least a
/// quarter as many voxels as the fullest level. 0 when there are no voxels.
[[nodiscard]] double floor_height_m(std::span<const OccupiedVoxel> voxels);

/// How high over the floor to cut: 2.2 m, or below the ceiling when that hangs lower: the lowest
/// level above 1.6 m that holds at least a quarter as many voxels as the floor.
/// Boundary: infinite when no voxel lies above 2.2 m and there is no ceiling.
[[nodiscard]] double ceiling_cut_m(std::span<const OccupiedVoxel> voxels, double floor_m);

struct CutawayOptions {
  double floor_m = 0.0;      ///< Height of the floor in the map.
  double cut_above_m = 2.2;  ///< Over the floor; voxels whose centre is higher are left out.
  /// Horizontal unit vector from the scene to the eye; none: near walls stay.
  std::optional<Eigen::Vector2d> towards_eye = std::nullopt;
  double wall_from_m = 1.5;    ///< What reaches so high over the floor can be a wall.
  double wall_stump_m = 0.25;  ///< What remains of a near wall.
  double wall_depth_m = 0.25;  ///< How much of a line of sight a near wall takes.
  double room_behind_m = 1.2;  ///< A wall is in the way when so much lies behind it.
};

/// The voxels that stay, in their order.
///
/// Near walls: over each line of sight across the plan, the first column that reaches
/// `wall_from_m`, when there is still room behind it. Labelled voxels are never cut as walls.
/// Cost: linear in the voxels.
[[nodiscard]] std::vector<OccupiedVoxel> cut_away(std::span<const OccupiedVoxel> voxels,
                                                  const CutawayOptions& options);

}  // namespace hypermap

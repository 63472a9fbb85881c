// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where one upright world lies in another.
#pragma once

#include <Eigen/Geometry>

namespace hypermap {

/// Where the world of an input lies in a map, or a map in another one, when +z is up in both.
struct WorldPlacement {
  double x_m = 0.0;
  double y_m = 0.0;
  double z_m = 0.0;
  double yaw_rad = 0.0;  ///< Counter-clockwise, about the world's own origin.
};

/// From coordinates in the world to those in the map.
[[nodiscard]] Eigen::Isometry3d isometry_of(const WorldPlacement& placement);

}  // namespace hypermap

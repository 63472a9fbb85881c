// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Polygons in another frame of the same plane.
#pragma once

#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Geometry>

namespace hypermap {

/// The polygon with each corner, those of holes too, moved from frame `from` to frame `to`. A rigid
/// motion keeps order and winding, and so everything that a polygon must be. Cost: O(corners).
[[nodiscard]] Polygon moved(Polygon polygon, const Eigen::Isometry2d& to_from);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How far points are from triangles in space.
#pragma once

#include <Eigen/Core>

#include <array>

namespace hypermap {

/// Corners in any order.
using Triangle = std::array<Eigen::Vector3d, 3>;

/// Square of the distance from a point to the nearest point of a triangle, its edges and corners
/// included.
///
/// Requires: finite coordinates.
/// Boundary: triangles without an area are the segments or points that they are.
[[nodiscard]] double squared_distance(const Eigen::Vector3d& point, const Triangle& triangle);

}  // namespace hypermap

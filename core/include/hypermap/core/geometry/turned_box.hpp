// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Upright boxes that lie as their object does.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Core>

namespace hypermap {

/// An upright box of any bearing. Its first two axes are horizontal, the third is +z. Unit: metre.
struct TurnedBox {
  Eigen::Matrix3d map_from_box = Eigen::Matrix3d::Identity();  ///< A rotation about z.
  Eigen::Vector3d low = Eigen::Vector3d::Zero();               ///< Along its own axes.
  Eigen::Vector3d high = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d extent() const { return high - low; }
  [[nodiscard]] double volume_m3() const { return extent().prod(); }
};

/// Of a box along the map's axes, with these axes.
[[nodiscard]] inline TurnedBox turned_box(const Box& box) {
  return {.low = box.min_in_map, .high = box.max_in_map};
}

/// The least rectangle around a convex outline, from one height to another, the longer horizontal
/// axis first. Of equals the one along the first edge; around an outline that is not convex the
/// least of those along one of its edges. Requires: a point or more; low_z_m <= high_z_m.
/// Cost: the square of the outline's corners.
[[nodiscard]] TurnedBox turned_box_around(const Ring& outline, double low_z_m, double high_z_m);

/// The smallest box along the map's axes around it.
[[nodiscard]] Box bounding_box(const TurnedBox& box);

/// Volume of the intersection over volume of the union; 0 when either has no volume.
/// Rounded by 1e-6 at most, as areas of polygons are. Source: [smap] B.6, figure B.6.1, in space.
[[nodiscard]] double intersection_over_union(const TurnedBox& a, const TurnedBox& b);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Axis-aligned boxes in the map.
///
/// Source: [smap] 3.3, 3D AABB estimation (pseudocode 3.2).
#pragma once

#include "hypermap/core/geometry/frames.hpp"

#include <Eigen/Core>

#include <array>
#include <span>

namespace hypermap {

/// The smallest axis-aligned cuboid around something. Frame: Map. Unit: metre.
struct Box {
  Eigen::Vector3d min_in_map = Eigen::Vector3d::Zero();
  Eigen::Vector3d max_in_map = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d centre() const { return 0.5 * (min_in_map + max_in_map); }
  [[nodiscard]] Eigen::Vector3d extent() const { return max_in_map - min_in_map; }
  [[nodiscard]] double volume_m3() const { return extent().prod(); }
  /// Closed: points on a face are inside.
  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const {
    return (p.array() >= min_in_map.array()).all() && (p.array() <= max_in_map.array()).all();
  }
  /// Closed: boxes that share a face overlap.
  [[nodiscard]] bool intersects(const Box& other) const {
    return (min_in_map.array() <= other.max_in_map.array()).all() &&
           (other.min_in_map.array() <= max_in_map.array()).all();
  }
  [[nodiscard]] std::array<Eigen::Vector3d, 8> corners() const;
  friend bool operator==(const Box&, const Box&) = default;
};

/// Requires: points not empty and finite.
[[nodiscard]] Box bounding_box(std::span<const Eigen::Vector3f> points_in_map);

/// The smallest box around both.
[[nodiscard]] inline Box bounding_box(const Box& a, const Box& b) {
  return {a.min_in_map.cwiseMin(b.min_in_map), a.max_in_map.cwiseMax(b.max_in_map)};
}

/// The box with each face moved outwards by `by_m`.
[[nodiscard]] inline Box grown(const Box& box, double by_m) {
  return {box.min_in_map.array() - by_m, box.max_in_map.array() + by_m};
}

/// Volume of the intersection over volume of the union; 0 when both volumes are 0.
[[nodiscard]] double intersection_over_union(const Box& a, const Box& b);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/triangle.hpp"

#include <Eigen/Geometry>

#include <algorithm>

namespace hypermap {
namespace {

using Eigen::Vector3d;

double squared_distance_to_segment(const Vector3d& point,
                                   const Vector3d& from,
                                   const Vector3d& to) {
  const Vector3d along = to - from;
  const double length2 = along.squaredNorm();
  const double share =
      length2 > 0.0 ? std::clamp((point - from).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (point - from - share * along).squaredNorm();
}

/// Whether the foot of the perpendicular from `point` lies inside; `normal` need not be of
/// length 1.
bool is_over_triangle(const Vector3d& point, const Triangle& triangle, const Vector3d& normal) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector3d& from = triangle[i];
    const Vector3d edge = triangle[(i + 1) % 3] - from;
    if (edge.cross(point - from).dot(normal) < 0.0) return false;
  }
  return true;
}

}  // namespace

double squared_distance(const Vector3d& point, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d normal = (b - a).cross(c - a);
  const double length2 = normal.squaredNorm();
  if (length2 > 0.0 && is_over_triangle(point, triangle, normal)) {
    const double height = (point - a).dot(normal);
    return height * height / length2;
  }
  return std::min({squared_distance_to_segment(point, a, b),
                   squared_distance_to_segment(point, b, c),
                   squared_distance_to_segment(point, c, a)});
}

}  // namespace hypermap

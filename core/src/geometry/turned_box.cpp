// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/turned_box.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

/// The rectangle around `ring` whose first axis is the unit vector `u`; its heights stay 0.
TurnedBox rectangle_along(const Eigen::Vector2d& u, const Ring& ring) {
  TurnedBox rectangle;
  rectangle.map_from_box.col(0) << u.x(), u.y(), 0.0;
  rectangle.map_from_box.col(1) << -u.y(), u.x(), 0.0;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  for (const Eigen::Vector2d& point : ring) {
    const Eigen::Vector2d along = rectangle.map_from_box.topLeftCorner<2, 2>().transpose() * point;
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  rectangle.low.head<2>() = low;
  rectangle.high.head<2>() = high;
  return rectangle;
}

double plan_area_m2(const TurnedBox& box) {
  return box.extent().head<2>().prod();
}

TurnedBox least_rectangle(const Ring& ring) {
  TurnedBox least = rectangle_along(Eigen::Vector2d::UnitX(), ring);
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d edge = ring[(i + 1) % ring.size()] - ring[i];
    if (edge.norm() <= 0.0) continue;
    const TurnedBox rectangle = rectangle_along(edge.normalized(), ring);
    // Differences that only rounding makes choose nothing.
    if (plan_area_m2(rectangle) < (1.0 - 1e-9) * plan_area_m2(least)) least = rectangle;
  }
  return least;
}

/// A quarter of a turn: the second axis becomes the first one.
TurnedBox quarter_turned(const TurnedBox& box) {
  TurnedBox turned = box;
  turned.map_from_box.col(0) = box.map_from_box.col(1);
  turned.map_from_box.col(1) = -box.map_from_box.col(0);
  turned.low.head<2>() << box.low.y(), -box.high.x();
  turned.high.head<2>() << box.high.y(), -box.low.x();
  return turned;
}

/// What a box covers from above, counter-clockwise.
Polygon plan_of(const TurnedBox& box) {
  const auto corner = [&box](double along, double across) -> Eigen::Vector2d {
    return box.map_from_box.topLeftCorner<2, 2>() * Eigen::Vector2d(along, across);
  };
  return {.outer = {corner(box.low.x(), box.low.y()),
                    corner(box.high.x(), box.low.y()),
                    corner(box.high.x(), box.high.y()),
                    corner(box.low.x(), box.high.y())},
          .holes = {}};
}

}  // namespace

TurnedBox turned_box_around(const Ring& outline, double low_z_m, double high_z_m) {
  TurnedBox box = least_rectangle(outline);
  if (box.extent().x() < box.extent().y()) box = quarter_turned(box);
  box.low.z() = low_z_m;
  box.high.z() = high_z_m;
  return box;
}

Box bounding_box(const TurnedBox& box) {
  const Box own{box.low, box.high};
  Box around{Eigen::Vector3d::Constant(std::numeric_limits<double>::max()),
             Eigen::Vector3d::Constant(std::numeric_limits<double>::lowest())};
  for (const Eigen::Vector3d& corner : own.corners()) {
    const Eigen::Vector3d in_map = box.map_from_box * corner;
    around.min_in_map = around.min_in_map.cwiseMin(in_map);
    around.max_in_map = around.max_in_map.cwiseMax(in_map);
  }
  return around;
}

double intersection_over_union(const TurnedBox& a, const TurnedBox& b) {
  const double common_height_m = std::min(a.high.z(), b.high.z()) - std::max(a.low.z(), b.low.z());
  if (!(a.volume_m3() > 0.0) || !(b.volume_m3() > 0.0) || !(common_height_m > 0.0)) return 0.0;
  const double common_m3 =
      covered_share(plan_of(a), plan_of(b)) * plan_area_m2(a) * common_height_m;
  return common_m3 / (a.volume_m3() + b.volume_m3() - common_m3);
}

}  // namespace hypermap

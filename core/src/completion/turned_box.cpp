// SPDX-License-Identifier: BSD-3-Clause
#include "turned_box.hpp"

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

}  // namespace

Ring outline_of(const Object& object) {
  if (auto shape = footprint(object)) return std::move(shape->outer);
  const Eigen::Vector3d& low = object.box.min_in_map;
  const Eigen::Vector3d& high = object.box.max_in_map;
  return {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}};
}

TurnedBox turned_box_of(const Object& object) {
  TurnedBox box = least_rectangle(outline_of(object));
  if (box.extent().x() < box.extent().y()) box = quarter_turned(box);
  box.low.z() = object.box.min_in_map.z();
  box.high.z() = object.box.max_in_map.z();
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

}  // namespace hypermap

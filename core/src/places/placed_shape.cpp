// SPDX-License-Identifier: BSD-3-Clause
#include "places/placed_shape.hpp"

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

Result<Polygon> rectangle_of(const Box& box) {
  const Eigen::Vector3d& low = box.min_in_map;
  const Eigen::Vector3d& high = box.max_in_map;
  return make_polygon(
      {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}});
}

Result<Polygon> plan_of(const Object& object) {
  auto of_points = footprint(object, ShapePolicy::kVoxels);
  if (of_points) return of_points;
  auto of_shapes = footprint(object, ShapePolicy::kBest);
  return of_shapes ? of_shapes : rectangle_of(object.box);
}

}  // namespace

std::optional<PlacedShape> placed_shape_of(const Object& object, const RelationOptions& options) {
  auto plan = plan_of(object);
  if (!plan) return std::nullopt;
  const auto best = best_class(object);
  const Eigen::Vector3d extent = object.box.extent();
  return PlacedShape{.id = object.id,
                     .class_id = best ? std::optional(best->id) : std::nullopt,
                     .box = object.box,
                     .footprint = *plan,
                     .surface = ColumnSurface(object.points.agreed_points(), voxel_of(options)),
                     .longest_side_m = std::max(extent.x(), extent.y()),
                     .volume_m3 = area_m2(*plan) * extent.z()};
}

double common_height_m(const PlacedShape& a, const PlacedShape& b) {
  return std::max(0.0, std::min(a.top_m(), b.top_m()) - std::max(a.foot_m(), b.foot_m()));
}

double most_covered_share(const PlacedShape& a, const PlacedShape& b) {
  const Rect first = bounds(a.footprint);
  const Rect second = bounds(b.footprint);
  const Eigen::Vector2d common =
      (first.max.cwiseMin(second.max) - first.min.cwiseMax(second.min)).cwiseMax(0.0);
  return std::min(1.0, common.prod() / area_m2(a.footprint));
}

}  // namespace hypermap

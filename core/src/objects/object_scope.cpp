// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_scope.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {

bool ActiveCone::contains(const Eigen::Vector3d& point_in_map) const {
  const Eigen::Vector3d way = point_in_map - apex.xyz;
  const double depth_m = way.dot(axis_in_map);
  return depth_m >= min_range_m && depth_m <= max_range_m &&
         depth_m >= std::cos(half_angle_rad) * way.norm();
}

bool operator==(const ActiveCone& a, const ActiveCone& b) {
  return a.apex.xyz == b.apex.xyz && a.axis_in_map == b.axis_in_map &&
         a.half_angle_rad == b.half_angle_rad && a.min_range_m == b.min_range_m &&
         a.max_range_m == b.max_range_m;
}

ActiveCone active_cone(const RgbdFrame& frame, double min_range_m, double max_range_m) {
  const PinholeCamera& camera = frame.camera;
  double half_angle_rad = 0.0;
  for (const double u : {0.0, camera.width_px - 1.0}) {
    for (const double v : {0.0, camera.height_px - 1.0}) {
      const Eigen::Vector3d ray = camera.unproject(u, v, 1.0).xyz;
      half_angle_rad = std::max(half_angle_rad, std::atan2(ray.head<2>().norm(), ray.z()));
    }
  }
  return {.apex = frame.map_from_camera.origin(),
          .axis_in_map = frame.map_from_camera.isometry().linear().col(2),
          .half_angle_rad = half_angle_rad,
          .min_range_m = min_range_m,
          .max_range_m = max_range_m};
}

bool ObjectScope::contains(const Eigen::Vector3d& centroid_in_map) const {
  return (!cone || cone->contains(centroid_in_map)) && (!is_near || is_near(centroid_in_map));
}

}  // namespace hypermap

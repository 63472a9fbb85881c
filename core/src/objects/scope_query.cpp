// SPDX-License-Identifier: BSD-3-Clause
#include "scope_query.hpp"

#include <cmath>

namespace hypermap {
namespace {

/// What lies on the cone's surface is in its bounds, however the two are rounded.
constexpr double kRoundingM = 1e-6;

}  // namespace

Box bounds(const ActiveCone& cone) {
  const Eigen::Vector3d& apex = cone.apex.xyz;
  const Eigen::Vector3d& axis = cone.axis_in_map;
  const Eigen::Vector3d centre = apex + cone.max_range_m * axis;
  const double radius_m = cone.max_range_m * std::tan(cone.half_angle_rad);
  // A disc reaches along an axis of the map as far as its own axis is turned away from that.
  const Eigen::Vector3d reach_m = radius_m * (1.0 - axis.array().square()).max(0.0).sqrt();
  return grown({apex.cwiseMin(centre - reach_m), apex.cwiseMax(centre + reach_m)}, kRoundingM);
}

std::vector<ObjectId> objects_in(const ObjectMap& objects, const ObjectScope& scope) {
  std::vector<ObjectId> ids;
  if (scope.cone) {
    ids = objects.query(bounds(*scope.cone));
  } else {
    for (const Object& object : objects.objects()) ids.push_back(object.id);
  }
  std::erase_if(ids, [&](ObjectId id) { return !scope.contains(objects.at(id).centroid_in_map); });
  return ids;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/listed_instances.hpp"

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

/// The axis from which yaw counts, level and of length 1.
Eigen::Vector3d level_axis(const Eigen::Vector3d& up) {
  const bool is_x_steep = std::abs(up.x()) > std::numbers::sqrt2 / 2.0;
  const Eigen::Vector3d axis = is_x_steep ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  return (axis - axis.dot(up) * up).normalized();
}

}  // namespace

InputFromInstance input_from_instance(const ListedInstance& instance,
                                      const Eigen::Vector3d& up_in_input) {
  const Eigen::Vector3d width =
      Eigen::AngleAxisd(instance.yaw_rad, up_in_input) * level_axis(up_in_input);
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear().col(0) = width;
  isometry.linear().col(1) = up_in_input.cross(width);
  isometry.linear().col(2) = up_in_input;
  isometry.translation() = instance.centre.xyz;
  return InputFromInstance(isometry);
}

Box box_in_map(const ListedInstance& instance,
               const Eigen::Vector3d& up_in_input,
               const MapFromInput& map_from_input) {
  const auto map_from_instance = map_from_input * input_from_instance(instance, up_in_input);
  const Eigen::Vector3d half_extent =
      map_from_instance.isometry().linear().cwiseAbs() * (0.5 * instance.size_m);
  const Eigen::Vector3d centre = map_from_instance.origin().xyz;
  return {centre - half_extent, centre + half_extent};
}

TurnedBox turned_box_in_map(const ListedInstance& instance,
                            const Eigen::Vector3d& up_in_input,
                            const MapFromInput& map_from_input) {
  const auto map_from_instance = map_from_input * input_from_instance(instance, up_in_input);
  const Eigen::Vector2d width = map_from_instance.isometry().linear().col(0).head<2>().normalized();
  TurnedBox box;
  box.map_from_box.col(0) << width, 0.0;
  box.map_from_box.col(1) << -width.y(), width.x(), 0.0;
  const Eigen::Vector3d centre = box.map_from_box.transpose() * map_from_instance.origin().xyz;
  box.low = centre - 0.5 * instance.size_m;
  box.high = centre + 0.5 * instance.size_m;
  return box;
}

}  // namespace hypermap

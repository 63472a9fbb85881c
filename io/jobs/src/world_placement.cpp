// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/world_placement.hpp"

namespace hypermap {

Eigen::Isometry3d isometry_of(const WorldPlacement& placement) {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.translation() = Eigen::Vector3d(placement.x_m, placement.y_m, placement.z_m);
  isometry.linear() =
      Eigen::AngleAxisd(placement.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return isometry;
}

}  // namespace hypermap

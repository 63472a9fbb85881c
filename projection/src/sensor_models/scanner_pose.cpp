// SPDX-License-Identifier: BSD-3-Clause
#include "scanner_pose.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {

Result<void> check_scanner_pose(const MapFromScanner& map_from_scanner) {
  constexpr double kMaxRotationError = 1e-3;
  constexpr double kMaxCoordinateM = 1e6;
  const Eigen::Isometry3d& pose = map_from_scanner.isometry();
  if (is_rigid(pose, kMaxRotationError) &&
      pose.translation().cwiseAbs().maxCoeff() <= kMaxCoordinateM) {
    return {};
  }
  return fail(ErrorCode::kInvalidArgument,
              "must be a finite rigid motion within 1e6 m",
              "map_from_scanner");
}

Result<PlanePose> level_pose(const MapFromScanner& map_from_scanner, double max_tilt_rad) {
  const Eigen::Isometry3d& pose = map_from_scanner.isometry();
  const double tilt_rad = std::acos(std::clamp(pose.linear()(2, 2), -1.0, 1.0));
  if (tilt_rad > max_tilt_rad) {
    return fail(ErrorCode::kInvalidArgument,
                "must be level within " + number_text(max_tilt_rad) + " rad, is tilted by " +
                    number_text(tilt_rad),
                "map_from_scanner");
  }
  const Eigen::Vector3d ahead = pose.linear().col(0);
  return PlanePose{pose.translation().head<2>(), std::atan2(ahead.y(), ahead.x())};
}

}  // namespace hypermap

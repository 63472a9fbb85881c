// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Poses of range sensors, in space and in the plan.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include <Eigen/Core>

namespace hypermap {

/// Where a level sensor stands in the plan, and where its +x looks.
struct PlanePose {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;
};

/// Errors: kInvalidArgument for a pose that is no finite rigid motion (rotation off by more than
/// 1e-3) or lies beyond 1e6 m.
[[nodiscard]] Result<void> check_scanner_pose(const MapFromScanner& map_from_scanner);

/// Errors: kInvalidArgument when the sensor's +z is more than `max_tilt_rad` from the map's.
[[nodiscard]] Result<PlanePose> level_pose(const MapFromScanner& map_from_scanner,
                                           double max_tilt_rad);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How a ray steps from voxel to voxel, in the arithmetic of OctoMap.
#pragma once

#include "octree/point_f.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hypermap {

/// Distances along a ray from the sensor.
///
/// Source: A. Hornung et al., "OctoMap": the traversal after J. Amanatides and A. Woo with the
/// precision of computeRayKeys (single-precision direction, double-precision distances), so that
/// the voxels are the same to the last one.
struct RaySteps {
  std::array<double, 3> next{};       ///< To the next face across each axis,
  std::array<double, 3> per_voxel{};  ///< and from that to the one behind it.
  std::array<int, 3> sign{};          ///< -1, 0 or 1: which way along each axis.
  double limit = 0.0;                 ///< It ends when all next faces lie beyond.
};

/// `sensor_voxel`: that of the sensor, from the map's origin.
[[nodiscard]] inline RaySteps ray_steps(const PointF& sensor,
                                        const std::array<int, 3>& sensor_voxel,
                                        const PointF& end,
                                        double resolution_m) {
  const PointF way = difference(end, sensor);
  const auto length_m = static_cast<float>(std::sqrt(static_cast<double>(squared_norm(way))));
  RaySteps steps;
  steps.next.fill(std::numeric_limits<double>::max());
  steps.per_voxel.fill(std::numeric_limits<double>::max());
  steps.limit = static_cast<double>(length_m);
  for (std::size_t i = 0; i < 3; ++i) {
    const float direction = way[i] / length_m;
    if (!(direction != 0.0F)) continue;
    steps.sign[i] = direction > 0.0F ? 1 : -1;
    const auto half_m = static_cast<float>(steps.sign[i] * resolution_m * 0.5);
    const double face_m =
        (static_cast<double>(sensor_voxel[i]) + 0.5) * resolution_m + static_cast<double>(half_m);
    const auto along = static_cast<double>(direction);
    steps.next[i] = (face_m - static_cast<double>(sensor[i])) / along;
    steps.per_voxel[i] = resolution_m / std::abs(along);
  }
  return steps;
}

}  // namespace hypermap

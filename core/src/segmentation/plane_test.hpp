// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a measured point may be one of a plane.
#pragma once

#include "background_planes.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <cmath>

namespace hypermap {

/// How far sensor noise moves a point along its ray.
[[nodiscard]] inline float noise_at(float depth_m, const ForegroundOptions& options) {
  return static_cast<float>(options.noise_factor * axial_noise_m(static_cast<double>(depth_m)));
}

/// Which points may be of a plane. They lie on it up to `thickness_m` and the part across the plane
/// of what noise moves them along their rays.
struct PlaneTest {
  Plane plane;
  float thickness_m = 0.0F;
  /// Of the tolerance that is meant, for a wider look.
  float scale = 1.0F;

  // In the order in which Eigen adds: a plane that is found by one is tested alike by the other.
  [[nodiscard]] float along_m(float x, float y, float z) const {
    return plane.normal.x() * x + (plane.normal.y() * y + plane.normal.z() * z);
  }
  /// Of a point on a ray with `along_m`.
  [[nodiscard]] float tolerance_m(float along, float z, float noise_m) const {
    return scale * thickness_m + scale * noise_m * (std::abs(along) / z);
  }
  [[nodiscard]] bool holds(float x, float y, float z, float noise_m) const {
    const float along = along_m(x, y, z);
    return std::abs(along + plane.offset_m) <= tolerance_m(along, z, noise_m);
  }
};

[[nodiscard]] inline PlaneTest test_of(const Plane& plane, const ForegroundOptions& options) {
  return {.plane = plane, .thickness_m = static_cast<float>(options.plane_thickness_m)};
}

}  // namespace hypermap

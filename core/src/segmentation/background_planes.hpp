// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The planes that surround a detection: floor, table top, wall.
#pragma once

#include "depth_window.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

/// Points p with normal . p + offset_m = 0. Frame: Camera.
struct Plane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();
  float offset_m = 0.0F;

  [[nodiscard]] float distance_m(const Eigen::Vector3f& point) const {
    return normal.dot(point) + offset_m;
  }
};

/// Which way is up, and where the floor is known to be. Frame: Camera.
struct UprightView {
  Eigen::Vector3f up = Eigen::Vector3f::UnitZ();  ///< Of length 1.
  /// Of the floor over the camera's origin, along `up`: negative below it.
  std::optional<float> floor_height_m = {};
};

/// How a frame stands in the world.
[[nodiscard]] UprightView upright_view(const RgbdFrame& frame);

/// The planes that hold most of what is outside the box, or outside the mask where there is one,
/// the largest first; last the floor, from less on, where none of them is it: by what is around the
/// object or, where its height is known, by all that is seen.
///
/// RANSAC over horizontal planes through one point (the map's z axis is up), upright ones through
/// two and free ones through three, each refined by least squares; the random numbers are fixed, so
/// the result is.
[[nodiscard]] std::vector<Plane> background_planes(const DepthWindow& window,
                                                   const UprightView& view,
                                                   const ForegroundOptions& options);

/// Per cell the first plane that its point may be one of, given the sensor's noise there, counted
/// from 1; 0 on none.
[[nodiscard]] std::vector<std::uint8_t> plane_of_cells(const DepthWindow& window,
                                                       const std::vector<Plane>& planes,
                                                       const ForegroundOptions& options);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which objects of the map a frame may be compared with.
///
/// Source: [smap] 3.5.4 and 3.5.5, steps 1, C.2.2 and C.1 of figures 3.22 and 3.23.
#pragma once

#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace hypermap {

/// The region in which a sensor measures: a cone around its axis, between two depths.
///
/// Source: [smap] figure 3.5: R_min, R_max and the field of view. Frame: Map.
struct ActiveCone {
  PointInMap apex;
  Eigen::Vector3d axis_in_map = Eigen::Vector3d::UnitX();  ///< Unit vector.
  double half_angle_rad = 1.0;
  double min_range_m = 0.0;  ///< Along the axis.
  double max_range_m = 0.0;

  /// Closed: what lies on its surface is inside.
  [[nodiscard]] bool contains(const Eigen::Vector3d& point_in_map) const;
  friend bool operator==(const ActiveCone&, const ActiveCone&);
};

/// The cone of a frame's camera: as wide as the pixel that looks farthest off the axis.
/// Requires: validate(frame), 0 <= min_range_m < max_range_m.
[[nodiscard]] ActiveCone active_cone(const RgbdFrame& frame,
                                     double min_range_m,
                                     double max_range_m);

/// Objects that are in all of what is given; all objects when nothing is. What it asks is where an
/// object is now, so that one that was created or moved a moment ago is asked as any other.
struct ObjectScope {
  /// Whether an object with such a centroid is at a place near the sensor's.
  std::function<bool(const Eigen::Vector3d& centroid_in_map)> is_near = {};
  /// The centroid lies in it.
  std::optional<ActiveCone> cone = {};

  [[nodiscard]] bool contains(const Eigen::Vector3d& centroid_in_map) const;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which panels of a binned depth map show the place of a box, and what they say of it.
///
/// Source: [smap] 3.5.5, figure 3.23, steps 3 to 6.
#pragma once

#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/segmentation/binned_depth_map.hpp"

#include <Eigen/Core>

#include <vector>

namespace hypermap {

/// Where a point lies as a camera sees it, in the axes of the map. Azimuth 0 is where the camera
/// looks, elevation 0 is its height. Unit: radian.
struct SphericalAngles {
  double azimuth_rad = 0.0;
  double elevation_rad = 0.0;
};

/// Angles of a panel, phi_cp, and of a corner, phi_cc. `heading_rad` is theta_camera.
///
/// Source: [smap] Eq. (3.24), (3.25). Erratum: the text prints the camera's coordinates minus the
/// point's, which is the direction to the camera; both angles are turned by pi, so their difference
/// is the same. Deviation: the elevation, without which the panels of a column cannot be told
/// apart.
[[nodiscard]] SphericalAngles angles_from_camera(const Eigen::Vector3d& point_in_map,
                                                 const Eigen::Vector3d& camera_in_map,
                                                 double heading_rad);

/// How far two points are apart as the camera sees them, phi_diff of both angles.
/// Source: [smap] Eq. (3.23).
[[nodiscard]] double angular_distance_rad(const SphericalAngles& corner,
                                          const SphericalAngles& panel);

/// Panels that lie before, inside and after a box. Source: [smap] figure 3.24, p_be, p_in, p_af.
struct PanelCounts {
  int before = 0;
  int inside = 0;
  int after = 0;
  [[nodiscard]] int all() const { return before + inside + after; }
  friend bool operator==(const PanelCounts&, const PanelCounts&) = default;
};

/// The panels of a frame by their angles; the middle of a panel's box is where it is.
class PanelMatches {
 public:
  /// Requires: `depth` outlives it.
  explicit PanelMatches(const BinnedDepthMap& depth);

  /// Steps 3, 5 and 6: each corner of the box takes the panel nearest to it by angle, wherever in
  /// or out of the image the corner lies; counted are the panels with a point in the rectangle of
  /// columns and rows that these span (public implementation of [smap]), by their distance from the
  /// camera: before the box's nearest point, inside, or after its farthest one, by more than
  /// `tolerance_m` each. Boundary: of equally near panels the first; all 0 when no panel has a
  /// point. Cost: linear in the panels.
  [[nodiscard]] PanelCounts count(const Box& box, double tolerance_m) const;

 private:
  struct Place {
    int column = 0;
    int row = 0;
    SphericalAngles angles;
    double distance_m = 0.0;
  };
  [[nodiscard]] const Place& nearest(const Eigen::Vector3d& corner_in_map) const;

  Eigen::Vector3d camera_in_map_;
  double heading_rad_ = 0.0;
  std::vector<Place> places_;  ///< Of panels with a point, row by row.
};

}  // namespace hypermap

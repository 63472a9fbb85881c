// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The part of a depth image that belongs to one detected object.
///
/// Source: [smap] Eq. (3.5): box, class vector and box confidence are the input of the map.
#pragma once

#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/segmentation/background_cells.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace hypermap {

/// What one frame shows of one object. Frame: Map. Unit: metre.
struct Segment {
  /// Surface points, thinned by a voxel grid; never empty. Ordered by the first pixel of each
  /// voxel. Where policy `kForeground` finds the top of a table that is seen too flat to be
  /// measured, points of it are among them.
  std::vector<Eigen::Vector3f> points_in_map;
  /// The depth pixels that lie on the object, row-major positions in the image, ascending.
  std::vector<std::uint32_t> pixel_indices;
  /// Where the detection's box shows something else. Empty with the sources' policies, which do not
  /// look beyond a box.
  BackgroundCells background;
  Box box;  ///< Of `points_in_map`.
  /// Middle of the box. Source: [smap] pseudocode 3.2, (min + max) / 2.
  Eigen::Vector3d centroid_in_map = Eigen::Vector3d::Zero();
  /// How compact the object is along the line of sight. Source: [smap] pseudocode 3.3.
  Probability box_confidence;
  double distance_m = 0.0;  ///< From the camera to `centroid_in_map`.

  friend bool operator==(const Segment&, const Segment&) = default;
};

/// Confidence in a box from the nearest and the farthest point of its object: 1 up to
/// `depth_slack_m` of extent, then falling by the share of the sensor's range that exceeds it.
///
/// Source: [smap] pseudocode 3.3: (den - (num - obj_ths)) / den, den = R_max - R_min.
/// Boundary: never below 0; extent exactly `depth_slack_m` gives 1.
/// Requires: all finite, min_range_m < max_range_m, depth_extent_m >= 0.
[[nodiscard]] Probability box_confidence(double depth_extent_m,
                                         double depth_slack_m,
                                         double min_range_m,
                                         double max_range_m);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Marks the voxels that rays pass through, in the arithmetic of OctoMap.
#pragma once

#include "bit_window.hpp"
#include "point_f.hpp"

#include <array>

namespace hypermap {

/// Rays of one frame: all begin at the sensor.
class RayMarker {
 public:
  /// Requires: the window outlives the marker and covers the sensor and every end, and one voxel
  /// around them.
  RayMarker(const WindowGeometry& window, double resolution_m, const PointF& sensor);

  /// Marks the voxels from the sensor's up to the one before that in which `end` lies; nothing when
  /// both are the same.
  ///
  /// Source: A. Hornung et al., "OctoMap": the traversal after J. Amanatides and A. Woo with the
  /// precision of computeRayKeys (single-precision direction, double-precision distances), so that
  /// the voxels are the same to the last one.
  void mark(const PointF& end, const BitMarker& passed) const;

 private:
  const WindowGeometry* window_;
  double resolution_m_;
  double voxels_per_m_;
  PointF sensor_;
  std::array<int, 3> sensor_voxel_{};   // from the map's origin
  std::array<int, 3> sensor_offset_{};  // from the window's corner
};

}  // namespace hypermap

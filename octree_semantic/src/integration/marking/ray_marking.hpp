// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Marks the voxels that rays pass through, in the arithmetic of OctoMap.
#pragma once

#include "bit_window.hpp"
#include "kernels/kernels.hpp"
#include "octree/point_f.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hypermap {

/// Rays of one frame: all begin at the sensor.
class RayMarker {
 public:
  /// Requires: the window outlives the marker and covers the sensor and every end, and one voxel
  /// around them.
  RayMarker(const WindowGeometry& window, double resolution_m, const PointF& sensor);

  /// So many rays at a time.
  static constexpr std::size_t kMaxRays = 256;

  /// Marks for each end the voxels from the sensor's up to the one before that in which it lies;
  /// nothing when both are the same. Source: as RaySteps. Requires: ends.size() <= kMaxRays.
  void mark(std::span<const PointF> ends, const BitMarker& passed) const;

 private:
  [[nodiscard]] std::uint32_t cell_of(const PointF& end) const;
  /// But for the last cell.
  [[nodiscard]] kernels::MarchedRay ray_to(const PointF& end) const;

  const WindowGeometry* window_;
  double resolution_m_;
  double voxels_per_m_;
  PointF sensor_;
  std::array<int, 3> sensor_voxel_{};  // from the map's origin
  std::uint32_t first_cell_ = 0;
  kernels::MarchedRay from_sensor_;  // what all rays have in common
  decltype(kernels::Kernels::march_rays) march_rays_;
};

}  // namespace hypermap

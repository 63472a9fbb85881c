// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From coordinates to cells of a window, fast and checked.
#pragma once

#include "bit_window.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"
#include "octree/point_f.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace hypermap {

/// "No voxel".
inline constexpr std::uint32_t kNoCell = 0xFFFF'FFFF;

/// Largest whole number that is not larger. Requires: |value| < 2^31.
[[nodiscard]] inline int floor_to_int(double value) noexcept {
  const int truncated = static_cast<int>(value);
  return truncated - (value < truncated ? 1 : 0);
}

/// Finds the cell of a point within that part of a window that lies in the volume of the map. Small
/// and without indirection: loops hold a copy.
class CellFinder {
 public:
  /// Requires: the window outlives this and keeps its place.
  CellFinder(const WindowGeometry& window, double resolution_m) noexcept
      : voxels_per_m_(1.0 / resolution_m) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int first = std::max(0, -window.corner(i));
      const int end = std::min(window.edge(i), kKeysPerAxis - window.corner(i));
      first_voxel_[i] = first + window.corner(i) - kOriginKey;
      num_voxels_[i] = static_cast<std::uint32_t>(std::max(0, end - first));
      summands_[i] = window.summands(i) + std::min(first, end);
    }
  }

  /// kNoCell outside. Requires: coordinates below 2^31 voxels.
  [[nodiscard]] std::uint32_t find(const PointF& point) const noexcept {
    const std::uint32_t x = offset(0, point[0]);
    const std::uint32_t y = offset(1, point[1]);
    const std::uint32_t z = offset(2, point[2]);
    const bool inside = x < num_voxels_[0] && y < num_voxels_[1] && z < num_voxels_[2];
    return inside ? summands_[0][x] + summands_[1][y] + summands_[2][z] : kNoCell;
  }

 private:
  /// Below the first voxel it wraps to a huge number, which is outside as well.
  [[nodiscard]] std::uint32_t offset(std::size_t axis, float coordinate_m) const noexcept {
    const double voxels = voxels_per_m_ * static_cast<double>(coordinate_m);
    return static_cast<std::uint32_t>(floor_to_int(voxels) - first_voxel_[axis]);
  }

  double voxels_per_m_;
  std::array<int, 3> first_voxel_{};
  std::array<std::uint32_t, 3> num_voxels_{};
  std::array<const std::uint32_t*, 3> summands_{};
};

}  // namespace hypermap

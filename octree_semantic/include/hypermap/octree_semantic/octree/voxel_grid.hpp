// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which voxel a point of the map lies in.
#pragma once

#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace hypermap {

/// Turns coordinates into keys and back for one edge length.
///
/// Deviation: OctoMap's `coordToKey` wraps around for far points; there is no such form here.
class VoxelGrid {
 public:
  /// Requires: resolution_m finite and > 0.
  explicit VoxelGrid(double resolution_m) noexcept
      : resolution_m_(resolution_m), voxels_per_m_(1.0 / resolution_m) {}

  [[nodiscard]] double resolution_m() const noexcept { return resolution_m_; }
  [[nodiscard]] double voxels_per_m() const noexcept { return voxels_per_m_; }

  /// Key along one axis. Boundary: a coordinate on the face of two voxels belongs to the upper one;
  /// none outside [-32768, 32768) voxels, for infinite and for NaN.
  [[nodiscard]] std::optional<std::uint16_t> key(double coordinate_m) const noexcept {
    const double voxels = voxels_per_m_ * coordinate_m;
    if (!(voxels >= -kOriginKey && voxels < kOriginKey)) return std::nullopt;
    const int truncated = static_cast<int>(voxels);
    return static_cast<std::uint16_t>(truncated - (voxels < truncated ? 1 : 0) + kOriginKey);
  }
  [[nodiscard]] std::optional<VoxelKey> key(const PointInMap& point) const noexcept {
    const auto x = key(point.xyz.x());
    const auto y = key(point.xyz.y());
    const auto z = key(point.xyz.z());
    if (!x || !y || !z) return std::nullopt;
    return VoxelKey{*x, *y, *z};
  }
  /// Middle of the voxels with this key along one axis.
  [[nodiscard]] double centre_m(std::uint16_t axis_key) const noexcept {
    return (static_cast<double>(static_cast<int>(axis_key) - kOriginKey) + 0.5) * resolution_m_;
  }
  [[nodiscard]] PointInMap centre(const VoxelKey& voxel) const {
    return {Eigen::Vector3d(centre_m(voxel.x), centre_m(voxel.y), centre_m(voxel.z))};
  }
  friend bool operator==(const VoxelGrid&, const VoxelGrid&) = default;

 private:
  double resolution_m_;
  double voxels_per_m_;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which voxel a point of the map lies in, and in which order voxels are visited.
///
/// Keys are OctoMap's: 16 levels, so 65,536 voxels along each axis, and key 32,768 begins at
/// coordinate 0. Source: A. Hornung et al., "OctoMap", Autonomous Robots 34 (2013), section 4.
#pragma once

#include "hypermap/core/frames.hpp"

#include <Eigen/Core>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hypermap {

/// Key of the voxel whose lower corner is the origin of the map.
inline constexpr int kOriginKey = 32768;
/// Voxels along each axis; a point outside them has no key.
inline constexpr int kKeysPerAxis = 65536;
/// Voxels along the edge of a brick.
inline constexpr int kBrickEdge = 8;
/// Voxels of a brick.
inline constexpr std::size_t kBrickVolume = 512;

/// Moves the lower 16 bits of `value` apart, so that two zero bits follow each of them.
[[nodiscard]] constexpr std::uint64_t spread_bits(std::uint32_t value) noexcept {
  std::uint64_t v = value & 0xFFFFU;
  v = (v | v << 16U) & 0x0000'00FF'0000'00FFULL;
  v = (v | v << 8U) & 0x0000'00F0'0F00'F00FULL;
  v = (v | v << 4U) & 0x0000'0C30'C30C'30C3ULL;
  return (v | v << 2U) & 0x0000'2492'4924'9249ULL;
}

/// Inverse of `spread_bits`: every third bit, the lowest first.
[[nodiscard]] constexpr std::uint32_t gather_bits(std::uint64_t spread) noexcept {
  std::uint64_t v = spread & 0x0000'2492'4924'9249ULL;
  v = (v | v >> 2U) & 0x0000'0C30'C30C'30C3ULL;
  v = (v | v >> 4U) & 0x0000'00F0'0F00'F00FULL;
  v = (v | v >> 8U) & 0x0000'00FF'0000'00FFULL;
  return static_cast<std::uint32_t>((v | v >> 16U) & 0xFFFFU);
}

/// Where a voxel stands among all voxels, per axis.
struct VoxelKey {
  std::uint16_t x = 0;
  std::uint16_t y = 0;
  std::uint16_t z = 0;

  /// Position in Morton order, 48 bits: x gives the lowest bit, then y, then z. It is the order in
  /// which OctoMap visits its leaves.
  [[nodiscard]] constexpr std::uint64_t morton() const noexcept {
    return spread_bits(x) | spread_bits(y) << 1U | spread_bits(z) << 2U;
  }
  [[nodiscard]] static constexpr VoxelKey from_morton(std::uint64_t code) noexcept {
    return {static_cast<std::uint16_t>(gather_bits(code)),
            static_cast<std::uint16_t>(gather_bits(code >> 1U)),
            static_cast<std::uint16_t>(gather_bits(code >> 2U))};
  }
  friend constexpr bool operator==(const VoxelKey&, const VoxelKey&) = default;
  /// Morton order.
  friend constexpr std::strong_ordering operator<=>(const VoxelKey& a, const VoxelKey& b) noexcept {
    return a.morton() <=> b.morton();
  }
};

/// Which brick a voxel belongs to: the Morton code of the voxel without its lowest nine bits.
struct BrickKey {
  std::uint64_t code = 0;

  [[nodiscard]] static constexpr BrickKey of(const VoxelKey& voxel) noexcept {
    return {voxel.morton() / kBrickVolume};
  }
  /// The voxel at the brick's lower corner.
  [[nodiscard]] constexpr VoxelKey corner() const noexcept {
    return VoxelKey::from_morton(code * kBrickVolume);
  }
  /// The voxel at position `cell` of the brick, in Morton order.
  [[nodiscard]] constexpr VoxelKey voxel(std::size_t cell) const noexcept {
    return VoxelKey::from_morton(code * kBrickVolume + cell);
  }
  friend constexpr auto operator<=>(const BrickKey&, const BrickKey&) = default;
};

/// Where a voxel lies within its brick, 0 .. 511, in Morton order.
[[nodiscard]] constexpr std::size_t cell_in_brick(const VoxelKey& voxel) noexcept {
  return static_cast<std::size_t>(voxel.morton() % kBrickVolume);
}

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

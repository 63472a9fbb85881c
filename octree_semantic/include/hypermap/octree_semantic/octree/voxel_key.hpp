// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How voxels and bricks are numbered, and in which order they are visited.
///
/// Keys are OctoMap's: 16 levels, so 65,536 voxels along each axis, and key 32,768 begins at
/// coordinate 0. Source: A. Hornung et al., "OctoMap", Autonomous Robots 34 (2013), section 4.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>

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
  v = (v | v << 16U) & 0x0000'0000'FF00'00FFULL;
  v = (v | v << 8U) & 0x0000'00F0'0F00'F00FULL;
  v = (v | v << 4U) & 0x0000'0C30'C30C'30C3ULL;
  return (v | v << 2U) & 0x0000'2492'4924'9249ULL;
}

/// Inverse of `spread_bits`: every third bit, the lowest first.
[[nodiscard]] constexpr std::uint32_t gather_bits(std::uint64_t spread) noexcept {
  std::uint64_t v = spread & 0x0000'2492'4924'9249ULL;
  v = (v | v >> 2U) & 0x0000'0C30'C30C'30C3ULL;
  v = (v | v >> 4U) & 0x0000'00F0'0F00'F00FULL;
  v = (v | v >> 8U) & 0x0000'0000'FF00'00FFULL;
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
  constexpr std::array<std::uint16_t, kBrickEdge> kSpread{0, 1, 8, 9, 64, 65, 72, 73};
  return static_cast<std::size_t>(kSpread[voxel.x & 7U] | kSpread[voxel.y & 7U] << 1 |
                                  kSpread[voxel.z & 7U] << 2);
}

/// The voxel at position `cell` of the brick whose lower corner `corner` is.
[[nodiscard]] constexpr VoxelKey voxel_in_brick(const VoxelKey& corner, std::size_t cell) noexcept {
  const auto gather = [](std::size_t bits) {
    return (bits & 1U) | (bits >> 2U & 2U) | (bits >> 4U & 4U);
  };
  return {static_cast<std::uint16_t>(corner.x | gather(cell)),
          static_cast<std::uint16_t>(corner.y | gather(cell >> 1U)),
          static_cast<std::uint16_t>(corner.z | gather(cell >> 2U))};
}

/// Whether two voxels lie in one brick.
[[nodiscard]] constexpr bool in_one_brick(const VoxelKey& a, const VoxelKey& b) noexcept {
  return ((a.x ^ b.x) | (a.y ^ b.y) | (a.z ^ b.z)) < kBrickEdge;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether a ray meets an occupied voxel of one brick.
#pragma once

#include <array>
#include <cstdint>

namespace hypermap {

/// A brick's occupied voxels, and where its lower corner lies, in voxels from the map's origin.
struct OccupiedBrick {
  std::array<int, 3> corner{};
  std::array<std::uint64_t, 8> occupied{};  // in Morton order
};

/// Faces of the smallest box around the occupied voxels, in voxels from the map's origin;
/// min > max when there are none.
struct VoxelBounds {
  std::array<int, 3> min{};
  std::array<int, 3> max{};
};
[[nodiscard]] VoxelBounds bounds_of(const OccupiedBrick& brick) noexcept;

/// A ray in metres, from `first` to `last` along a direction of length 1.
struct WalkedRay {
  std::array<float, 3> origin{};
  std::array<float, 3> direction{};
  float first = 0.0F;
  float last = 0.0F;
};

/// Source: J. Amanatides and A. Woo, "A fast voxel traversal algorithm", Eurographics 1987.
/// Boundary: within a millionth of the coordinates from an edge, either answer.
[[nodiscard]] bool meets_occupied(const OccupiedBrick& brick,
                                  double resolution_m,
                                  const WalkedRay& ray) noexcept;

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What can be seen of a set of voxels: the occupied ones, their exposed faces, and how open each
/// corner of a face is to light.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/leaf.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// One occupied leaf. Frame: Map.
struct OccupiedVoxel {
  Eigen::Vector3f centre_in_map = Eigen::Vector3f::Zero();
  float edge_m = 0.0F;
  std::optional<ClassId> class_id = std::nullopt;
};

/// The occupied leaves in the order of the source; those with an edge or centre that is not finite
/// or beyond 1e6 m are left out.
[[nodiscard]] std::vector<OccupiedVoxel> occupied_voxels(const LeafSource& leaves);

/// The smallest edge; 0 when there is none.
[[nodiscard]] float finest_edge_m(std::span<const OccupiedVoxel> voxels);

/// The way a face looks.
enum class FaceDirection : std::uint8_t { kEast, kWest, kNorth, kSouth, kUp, kDown };
inline constexpr std::size_t kNumFaceDirections = 6;

/// Unit vector of a direction: east is +x, north +y, up +z.
[[nodiscard]] Eigen::Vector3f normal_of(FaceDirection direction);

/// The two axes of a face, so that corner k lies at (k & 1) along the first and (k >> 1) along the
/// second; their cross product is the normal.
struct FaceAxes {
  Eigen::Vector3f first;
  Eigen::Vector3f second;
};
[[nodiscard]] FaceAxes axes_of(FaceDirection direction);

/// A face of a voxel that no other voxel of the same edge covers.
struct VoxelFace {
  std::uint32_t voxel_index = 0;
  FaceDirection direction = FaceDirection::kUp;
  /// Per corner 0 (in a nook) .. 3 (open): of the three neighbours that lie around the corner on
  /// the face's side, how many are empty; two side neighbours close a corner entirely.
  std::array<std::uint8_t, 4> openness{};
};

/// The exposed faces that look towards one of `directions`, in the order of the voxels.
///
/// Voxels larger than the finest edge keep all their faces and are seen as open (they are few: our
/// own maps have none). Errors: kLimit for more than 2^25 faces; kOutOfMemory.
/// Cost: O(voxels), about 0.2 us each.
[[nodiscard]] Result<std::vector<VoxelFace>> exposed_faces(
    std::span<const OccupiedVoxel> voxels, std::span<const FaceDirection> directions);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What can be seen of a set of voxels, as few rectangles.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

using LatticePoint = std::array<std::int32_t, 3>;

/// An occupied voxel: its lower corner in edges of a voxel, and which colour it has, by number.
struct ColoredVoxel {
  LatticePoint low = {};
  std::uint32_t color = 0;
};

/// Exposed faces of one colour that fill a rectangle.
struct FaceRectangle {
  std::uint32_t color = 0;
  int axis = 0;             ///< Of its normal: x, y or z.
  bool faces_high = false;  ///< Whether the normal leads along the axis, else against it.
  LatticePoint low = {};    ///< Corner of the least coordinates; `low[axis] == high[axis]`.
  LatticePoint high = {};   ///< The opposite one.
  friend bool operator==(const FaceRectangle&, const FaceRectangle&) = default;
};

/// Every face of a voxel towards a place without a voxel is in one rectangle, of its colour; no
/// other face is in any. Faces of a row are merged first, then equal rows that lie side by side.
///
/// Requires: each voxel once, fewer than 2^20 of them along each axis.
/// Order: by axis, side, colour, then place. Cost: O(n log n).
[[nodiscard]] std::vector<FaceRectangle> merged_faces(std::span<const ColoredVoxel> voxels);

/// Triangles between corners of a lattice, counter-clockwise as they are seen from outside.
struct LatticeMesh {
  std::vector<LatticePoint> points = {};      ///< Each once.
  std::vector<std::uint32_t> triangles = {};  ///< Three numbers of points each.
};

/// Two triangles a rectangle, in their order.
[[nodiscard]] LatticeMesh mesh_of(std::span<const FaceRectangle> rectangles);

}  // namespace hypermap

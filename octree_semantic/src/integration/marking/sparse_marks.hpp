// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Bits for the voxels that a scan touches, wherever they lie: memory follows touched bricks, not
/// their bounding box.
#pragma once

#include "bit_window.hpp"
#include "hypermap/octree_semantic/octree/voxel_key.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// Touched bricks, numbered 0, 1, 2, ... in the order in which they were first touched, each with a
/// bit per voxel in three layers. A cell number is 512 times the number of its brick plus its place
/// in the brick, as in WindowGeometry.
class SparseMarks {
 public:
  /// Most bricks: their cells have 32-bit numbers, the last of which is "no cell".
  static constexpr std::size_t kMaxBricks = 0xFFFF'FFFF / kBrickVolume;

  BitLayer hit;     ///< Voxels in which measurements end within the range.
  BitLayer passed;  ///< Voxels that rays went through.
  BitLayer ends;    ///< Voxels in which measurements end at any distance.

  /// Forgets all bricks; keeps the memory. No more than `max_bricks` can be touched from now on.
  /// Requires: max_bricks > 0.
  void start(std::size_t max_bricks);
  /// The number of the brick, a new one when it was not touched; kNone when that would be one too
  /// many. Throws std::bad_alloc.
  [[nodiscard]] std::uint32_t touch(BrickKey key);
  static constexpr std::uint32_t kNone = 0xFFFF'FFFF;

  [[nodiscard]] std::size_t num_bricks() const noexcept { return keys_.size(); }
  [[nodiscard]] BrickKey key(std::size_t brick) const noexcept { return keys_[brick]; }
  void clear() noexcept;

  /// What `num_bricks` bricks take at most, the growing of the tables included. Ascending.
  [[nodiscard]] static std::size_t bytes_for(std::size_t num_bricks) noexcept;

 private:
  void grow();

  std::vector<std::uint32_t> slots_;  // open addressing; numbers, kNone where empty
  std::vector<BrickKey> keys_;
  std::size_t max_bricks_ = 0;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Voxels of a brick that one label is said of, merged together.
#pragma once

#include "hypermap/octree_semantic/octree/voxel_label.hpp"
#include "kernels/kernels.hpp"
#include "octree/brick.hpp"

#include <array>
#include <cstddef>

namespace hypermap {

/// Gathers labels into lanes for the kernel `merge_labels`, which does what `observe` does to one.
class BeliefBatch {
 public:
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  /// Requires: the label stays where it is until `merge`; at most 512 of them.
  void add(VoxelLabel& label) noexcept;
  /// Adds the scores to all, and forgets them.
  void merge(const kernels::LabelScores& scores) noexcept;

 private:
  kernels::BeliefLanes lanes_;
  std::array<VoxelLabel*, kBrickVolume> labels_{};
  std::size_t size_ = 0;
};

}  // namespace hypermap

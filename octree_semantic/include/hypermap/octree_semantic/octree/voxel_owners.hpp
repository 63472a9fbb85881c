// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The class that a voxel shows: that of the confirmed object it belongs to.
///
/// A voxel's own belief is evidence: each frame's mistakes are in it, and those of segments that
/// took in what lies behind an object. What a map says of a voxel is what it says of the object
/// that owns it (docs/CONVENTIONS.md, "The class of a voxel").
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/geometry/box.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <optional>
#include <span>
#include <unordered_map>

namespace hypermap {

/// What an object lends to its voxels.
struct OwnerLabel {
  ClassId class_id;     ///< Its best class.
  LogOdds probability;  ///< That it is real and of that class.
};

/// Confirmed objects, asked by voxels. Cost: a table look-up a voxel.
class VoxelOwners {
 public:
  /// Ids that are no objects, and objects without a class, own nothing.
  VoxelOwners(const ObjectMap& objects, std::span<const ObjectId> confirmed);

  /// Of a cube of that edge that is labelled with `object`. Null when that is no confirmed object,
  /// or when the cube does not reach its box grown by 5 cm, which a surface may be measured off: a
  /// single segment that took the floor in labels voxels too.
  [[nodiscard]] const OwnerLabel* find(ObjectId object,
                                       const Eigen::Vector3d& centre_in_map,
                                       double edge_m) const;
  /// The leaf with its owner's class, and with neither class nor object when it has no owner.
  [[nodiscard]] LeafSample owned(const LeafSample& leaf) const;

 private:
  struct Owner {
    OwnerLabel label;
    Box bounds;
  };
  std::unordered_map<ObjectId, Owner> owners_;
};

/// The voxels of the octree as `VoxelOwners::owned`. Requires: `octree` outlives the result.
[[nodiscard]] LeafSource owned_leaves(const SemanticOctree& octree, VoxelOwners owners);

}  // namespace hypermap

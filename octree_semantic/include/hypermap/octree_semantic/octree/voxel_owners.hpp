// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The class that a voxel shows: that of the confirmed object it belongs to.
///
/// A voxel's own belief is evidence: each frame's mistakes are in it, and those of segments that
/// took in what lies behind an object. What a map says of a voxel is what it says of the object
/// that owns it (docs/CONVENTIONS.md, "The class of a voxel").
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/log_odds.hpp"
#include "hypermap/core/geometry/leaf.hpp"
#include "hypermap/core/objects/object_map.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <memory>
#include <optional>
#include <span>

namespace hypermap {

/// What an object lends to its voxels.
struct OwnerLabel {
  ClassId class_id;     ///< Its best class.
  LogOdds probability;  ///< That it is real and of that class.
};

/// Confirmed objects, asked by voxels.
///
/// A voxel belongs to the object whose surface is nearest to its middle, and no farther than half
/// its edge and 3.25 cm: depth is noisy, and points have gaps. The surface's distance is the mean
/// of those to the object's nearest supported point (OccupancyVotes) and to its nearest point of
/// all, so that what few observations show counts where more stands beside it. The object that
/// the voxel is labelled with counts as 2.5 mm nearer, since a segment said so of the voxel itself;
/// of equals the lowest id has it. Asked are objects whose box comes as near as twice that.
/// Boundary: an object without points stands for its box, and only owns what is labelled with it;
/// one without a supported point owns nothing.
/// Cost: O(log n) a voxel for each of these objects, for n points; about 40 B a point.
class VoxelOwners {
 public:
  /// Ids that are no objects, and objects without a class, own nothing.
  VoxelOwners(const ObjectMap& objects, std::span<const ObjectId> confirmed);

  struct Owned {
    ObjectId object;
    OwnerLabel label;
  };
  /// Whom an occupied cube of that edge belongs to that is labelled with `object`; none: nobody.
  [[nodiscard]] std::optional<Owned> find(ObjectId object,
                                          const Eigen::Vector3d& centre_in_map,
                                          double edge_m) const;
  /// The leaf with its owner's class, and with neither class nor object when it has no owner.
  [[nodiscard]] LeafSample owned(const LeafSample& leaf) const;

 private:
  struct Index;
  std::shared_ptr<const Index> index_;  ///< Never null; shared by copies.
};

/// The voxels of the octree as `VoxelOwners::owned`. Requires: `octree` outlives the result.
[[nodiscard]] LeafSource owned_leaves(const SemanticOctree& octree, VoxelOwners owners);

}  // namespace hypermap

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
/// A voxel belongs to the object that it is labelled with, when that is a confirmed one and has
/// supported points (OccupancyVotes) within 5 cm of the cube, which a surface may be measured off:
/// a single segment that took the floor in labels voxels too. Any other voxel belongs to the
/// confirmed object that has most supported points within 1 cm of the cube, the lowest id of
/// equals: no segment names all voxels of a surface. Where none has, it belongs to the only one
/// that has supported points within 5 cm and encloses its middle: the convex hull of its agreed
/// points does from above, its box in height, a voxel above its lowest face. An object without
/// points stands for its box grown by 5 cm, and only owns what is labelled with it.
/// Cost: a table look-up a voxel and bits of its owner's points, else a query of the objects there;
/// memory a bit for each cell of 1 cm of an object's box, at most 128 KB an object.
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

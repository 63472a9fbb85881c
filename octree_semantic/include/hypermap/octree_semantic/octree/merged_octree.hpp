// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What two maps of one place know together: an octree added to another.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <cstdint>
#include <functional>

namespace hypermap {

/// What a voxel of the added map says where evidence reached a clamp there.
enum class ClampedVoxels : std::uint8_t {
  kAdd,      ///< The clamp, as if that were all that its frames said.
  kReplace,  ///< That it is so now: its frames came later, and as many as it takes said so.
};

struct OctreeMergeOptions {
  /// What the objects and classes of the added map are called in the other one; empty: the same.
  /// kNoObject: of none.
  std::function<ObjectId(ObjectId)> object_of = {};
  std::function<ClassId(ClassId)> class_of = {};
  ClampedVoxels clamped = ClampedVoxels::kAdd;
};

/// `octree` with what `added` knows besides, from other frames of the same world.
///
/// Log-odds add up, as those of frames do, and then stop at the clamps; voxels that one of both
/// knows stay as they are there. So what no clamp ever stopped has the same log-odds, to the bit,
/// in whatever order maps are added, and as if one map had had all frames. At a clamp it is known
/// that there was at least so much evidence, not how much: a sum with it may be too small, and
/// depends on the order of three maps. Labels add up by `sum_of`. The lattice is the same: move
/// `added` before (`transformed`), which is exact for shifts by whole voxels.
///
/// Errors: kInvalidArgument when the options of the two differ, naming the field with both values;
/// kOutOfMemory. Cost: linear in the bricks of `added`, and what a copy of `octree` that is kept
/// shares with it is copied where it is written: hand it over to have it grow in place.
[[nodiscard]] Result<SemanticOctree> merged(SemanticOctree octree,
                                            const SemanticOctree& added,
                                            const OctreeMergeOptions& options = {});

}  // namespace hypermap

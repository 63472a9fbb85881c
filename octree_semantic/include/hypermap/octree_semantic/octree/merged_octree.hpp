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

/// How two maps were made.
enum class MergedTimes : std::uint8_t {
  kBeside,  ///< At the same time, or nobody knows when.
  kLater,   ///< The frames of the added map came after all those of the other.
};

struct OctreeMergeOptions {
  /// What the objects and classes of the added map are called in the other one; empty: the same.
  /// kNoObject: of none.
  std::function<ObjectId(ObjectId)> object_of = {};
  std::function<ClassId(ClassId)> class_of = {};
  MergedTimes times = MergedTimes::kBeside;
};

/// `octree` with what `added` knows besides, from other frames of the same world.
///
/// Log-odds add up, as those of frames do, and then stop at the clamps; voxels that one of both
/// knows stay as they are there. So what no clamp ever stopped has the same log-odds, to the bit,
/// in whatever order maps are added, and as if one map had had all frames. At a clamp it is known
/// that there was at least so much evidence, not how much: a sum with it may be too small, and
/// depends on the order of three maps. A map of later frames therefore replaces what was known of a
/// voxel where its own evidence was once stopped by a clamp: so many frames would have brought the
/// voxel there from anywhere. That it was is seen by the log-odds, which hits and misses lead to
/// from the clamp in fewer steps than from 0. Labels add up by `sum_of`. The lattice is the same:
/// move `added` before (`transformed`), which is exact for shifts by whole voxels.
///
/// Errors: kInvalidArgument when the options of the two differ, naming the field with both values;
/// kOutOfMemory. Cost: linear in the bricks of `added`, and what a copy of `octree` that is kept
/// shares with it is copied where it is written: hand it over to have it grow in place.
[[nodiscard]] Result<SemanticOctree> merged(SemanticOctree octree,
                                            const SemanticOctree& added,
                                            const OctreeMergeOptions& options = {});

}  // namespace hypermap

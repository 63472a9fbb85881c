// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What is known of maps before they are merged: which were made when, and where each lies; and
/// their merging by that.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/jobs/merge_job.hpp"
#include "hypermap/octree_semantic/octree/transformed_octree.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// A map as it will be added.
struct PlannedMap {
  const MergedFile* file = nullptr;
  std::optional<Stamp> first = std::nullopt;  ///< Of its frames, as far as its runs tell.
  std::optional<Stamp> last = std::nullopt;
  std::size_t num_sessions = 0;
  /// Where it lies in the frame in which maps are added, the first file's until
  /// place_in_oldest; none: where it says itself.
  std::optional<MapFromOldMap> sum_from_map = std::nullopt;
  std::optional<MapPlacement> found = std::nullopt;  ///< Where that was found by registering.
  bool has_stack = false;                            ///< A layer `stack` of mapping.
  std::vector<Finding> findings = {};                ///< What its runs tell.
};

/// The maps in the order in which they are added. Their voxels and objects are not read.
/// Errors: as run_merge says of what needs neither.
[[nodiscard]] Result<std::vector<PlannedMap>> plan_merge(const MergeJob& job);

/// Places all in the frame of the one that is added first, so that what becomes one object does not
/// depend on which file was given first. Returns where that frame lies in the first file's; none
/// where it is the same, and where a map is tilted in another, which cannot be moved at all.
[[nodiscard]] std::optional<MapFromOldMap> place_in_oldest(std::span<PlannedMap> plan);

/// Adds the maps in their order, never more than two in memory, moves the sum by `result_from_sum`
/// and derives the layers.
/// Requires: what they point to is there still; `job.files` is not looked at.
/// Errors: as run_merge says of what needs voxels and objects.
[[nodiscard]] Result<MergeResult> merge_planned(
    std::span<const PlannedMap> plan,
    const MergeJob& job,
    const JobProgress& progress,
    const std::optional<MapFromOldMap>& result_from_sum = std::nullopt);

/// The error with the name of the map, where it has none.
[[nodiscard]] Unexpected about_map(const MergedFile& file, Error error);

}  // namespace hypermap

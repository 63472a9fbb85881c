// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Thins points to one per cube.
///
/// Source: [smap] Eq. (3.8), floor(p / S_leaf) on each axis.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

struct ThinnedCloud {
  std::vector<Eigen::Vector3f> centroids;     ///< Mean of each voxel's points, by first point.
  std::vector<std::uint32_t> voxel_of_point;  ///< Position in `centroids`, per input point.
};

/// Requires: finite points within 2^20 leaves of the origin; leaf_size_m >= 0, where 0 makes each
/// point its own voxel. Cost: O(n), one hash table.
[[nodiscard]] ThinnedCloud voxel_grid(std::span<const Eigen::Vector3f> points, double leaf_size_m);

/// Only in how many voxels the points lie.
[[nodiscard]] std::size_t count_voxels(std::span<const Eigen::Vector3f> points, double leaf_size_m);

}  // namespace hypermap

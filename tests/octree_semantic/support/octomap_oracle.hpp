// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// OctoMap itself as the reference for occupancy.
#pragma once

#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <octomap/octomap.h>

#include <cstddef>
#include <map>

namespace hypermap::test {

/// Log-odds of OctoMap's leaves at the finest level.
using OctomapLeaves = std::map<VoxelKey, float>;

inline void insert_frame(octomap::OcTree& tree,
                         const RgbdFrame& frame,
                         double max_range_m,
                         bool discretize) {
  octomap::Pointcloud cloud;
  for (const Eigen::Vector3f& point : measured_points(frame)) {
    cloud.push_back(point.x(), point.y(), point.z());
  }
  const Eigen::Vector3f origin = frame.map_from_camera.origin().xyz.cast<float>();
  tree.insertPointCloud(
      cloud, octomap::point3d(origin.x(), origin.y(), origin.z()), max_range_m, false, discretize);
}

/// Pruned nodes come as the leaves that they stand for.
inline OctomapLeaves leaves_of(const octomap::OcTree& pruned) {
  octomap::OcTree tree(pruned);
  tree.expand();
  OctomapLeaves leaves;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey& key = leaf.getKey();
    leaves[VoxelKey{key[0], key[1], key[2]}] = leaf->getLogOdds();
  }
  return leaves;
}

/// How two maps of the same frames agree.
struct Agreement {
  std::size_t both_occupied = 0;
  std::size_t either_occupied = 0;
  std::size_t both_free = 0;
  std::size_t either_free = 0;
  std::size_t only_theirs_known = 0;  ///< A ray of OctoMap's passed there, none of ours.
  std::size_t only_ours_known = 0;
  std::size_t by_rounding = 0;  ///< Judged differently, log-odds within `rounding` of each other.
  std::size_t otherwise = 0;    ///< Judged differently, log-odds farther apart.
  double largest_difference = 0.0;  ///< Of the log-odds of voxels known to both.

  void count(bool their_occupied, bool our_occupied, bool our_free) {
    both_occupied += their_occupied && our_occupied ? 1U : 0U;
    either_occupied += their_occupied || our_occupied ? 1U : 0U;
    both_free += !their_occupied && our_free ? 1U : 0U;
    either_free += !their_occupied || our_free ? 1U : 0U;
  }
  [[nodiscard]] double occupied_iou() const {
    return static_cast<double>(both_occupied) / static_cast<double>(either_occupied);
  }
  [[nodiscard]] double free_iou() const {
    return static_cast<double>(both_free) / static_cast<double>(either_free);
  }
};

/// Classifies every voxel known to either. `rounding`: how far steps of 0.001 may drift apart.
inline Agreement compare(const SemanticOctree& ours,
                         const octomap::OcTree& theirs,
                         double rounding) {
  Agreement result;
  const OctomapLeaves leaves = leaves_of(theirs);
  for (const auto& [key, log_odds] : leaves) {
    const auto sample = ours.at(key);
    const bool their_occupied = log_odds >= theirs.getOccupancyThresLog();
    const bool our_occupied = sample && sample->occupied;
    result.count(their_occupied, our_occupied, sample && !our_occupied);
    if (!sample) {
      ++result.only_theirs_known;
      continue;
    }
    const double difference = std::abs(sample->occupancy.value() - static_cast<double>(log_odds));
    result.largest_difference = std::max(result.largest_difference, difference);
    if (their_occupied != our_occupied) {
      ++(difference <= rounding ? result.by_rounding : result.otherwise);
    }
  }
  ours.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    if (leaves.contains(leaf.key)) return;
    ++result.only_ours_known;
    const bool occupied = ours.at(leaf.key)->occupied;
    ++(occupied ? result.either_occupied : result.either_free);
  });
  return result;
}

}  // namespace hypermap::test

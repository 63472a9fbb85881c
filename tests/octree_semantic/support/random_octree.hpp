// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Octrees made of voxels without a rule, and what is stored in one.
#pragma once

#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace hypermap::test {

inline SemanticOctree empty_tree(double resolution_m = 0.1) {
  return SemanticOctree::create({.resolution_m = resolution_m}).value();
}

inline VoxelLabel label_of(std::uint16_t class_id, std::uint32_t object) {
  VoxelLabel label;
  label.classes[0] = {class_id, 2000};
  label.object = ObjectId{object};
  label.object_votes = object == 0 ? 0 : 1;
  return label;
}

/// A cloud of voxels around the origin, every third labelled.
inline std::vector<StoredLeaf> random_leaves(std::size_t count) {
  std::mt19937 random(11);
  const auto axis = [&random] { return static_cast<std::uint16_t>(32748 + random() % 40); };
  std::set<VoxelKey> keys;
  while (keys.size() < count) keys.insert({axis(), axis(), axis()});
  std::vector<StoredLeaf> leaves;
  for (const VoxelKey& key : keys) {
    StoredLeaf leaf{
        .key = key,
        .log_odds = static_cast<MilliLogOdds>(-2000 + static_cast<int>(random() % 5500))};
    if (random() % 3 == 0) {
      const auto object = static_cast<std::uint32_t>(1 + random() % 3);
      leaf.label = label_of(static_cast<std::uint16_t>(random() % 4), object);
    }
    leaves.push_back(leaf);
  }
  return leaves;  // in Morton order
}

inline std::vector<StoredLeaf> stored(const SemanticOctree& tree) {
  std::vector<StoredLeaf> leaves;
  tree.for_each_stored_leaf([&](const StoredLeaf& leaf) { leaves.push_back(leaf); });
  return leaves;
}

}  // namespace hypermap::test

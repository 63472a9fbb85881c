// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/free_way.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

/// A wall of one voxel of 5 cm in the plane x = 1 m.
SemanticOctree octree_with_wall() {
  std::vector<StoredLeaf> leaves;
  leaves.reserve(400);
  for (int y = -10; y < 10; ++y) {
    for (int z = -10; z < 10; ++z) {
      leaves.push_back({{static_cast<std::uint16_t>(kOriginKey + 20),
                         static_cast<std::uint16_t>(kOriginKey + y),
                         static_cast<std::uint16_t>(kOriginKey + z)},
                        847});
    }
  }
  return SemanticOctree::from_leaves({}, leaves).value();
}

TEST(FreeWay, AWallIsInTheWayAndUnknownSpaceIsNot) {
  const SemanticOctree octree = octree_with_wall();
  EXPECT_FALSE(is_way_free(octree, {0, 0, 0}, {2, 0, 0}));
  EXPECT_FALSE(is_way_free(octree, {2, 0.1, 0.1}, {0, 0, 0}));
  EXPECT_TRUE(is_way_free(octree, {0, 0, 0}, {0.9, 0, 0}));
  EXPECT_TRUE(is_way_free(octree, {0, 0, 2}, {2, 0, 2}));
}

TEST(FreeWay, TheVoxelsOfBothEndsDoNotCount) {
  const SemanticOctree octree = octree_with_wall();
  EXPECT_TRUE(is_way_free(octree, {0, 0, 0}, {1.02, 0, 0}));
  EXPECT_TRUE(is_way_free(octree, {1.02, 0, 0}, {1.02, 0, 0}));
}

}  // namespace
}  // namespace hypermap

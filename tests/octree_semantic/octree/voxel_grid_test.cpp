// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_grid.hpp"

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <cmath>
#include <limits>
#include <random>

namespace hypermap {
namespace {

TEST(VoxelGrid, TheOriginIsTheLowerCornerOfKey32768) {
  const VoxelGrid grid(0.05);
  EXPECT_EQ(grid.key(0.0), 32768);
  EXPECT_EQ(grid.key(-0.0), 32768);
  EXPECT_EQ(grid.key(-1e-12), 32767);
  EXPECT_EQ(grid.key(0.049), 32768);
  EXPECT_EQ(grid.key(0.1), 32770);
  EXPECT_DOUBLE_EQ(grid.centre_m(32768), 0.025);
}

TEST(VoxelGrid, FarPointsHaveNoKeyInsteadOfAWrappedOne) {
  const VoxelGrid grid(0.5);  // the volume is [-16384 m, 16384 m)
  EXPECT_EQ(grid.key(-16384.0), 0);
  EXPECT_EQ(grid.key(16383.9), 65535);
  EXPECT_FALSE(grid.key(16384.0));
  EXPECT_FALSE(grid.key(-16384.1));
  EXPECT_FALSE(grid.key(1e300));
}

TEST(VoxelGrid, WhatIsNoNumberHasNoKey) {
  const VoxelGrid grid(0.05);
  EXPECT_FALSE(grid.key(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(grid.key(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(grid.key(-std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(grid.key(PointInMap{{0.0, std::nan(""), 0.0}}));
  EXPECT_EQ(grid.key(std::numeric_limits<double>::denorm_min()), 32768);
}

TEST(VoxelGrid, KeysAndCentresAreThoseOfOctomap) {
  std::mt19937 random(3);
  for (const double resolution_m : {0.02, 0.05, 0.1}) {
    const VoxelGrid grid(resolution_m);
    const octomap::OcTree octomap_tree(resolution_m);
    std::uniform_real_distribution<double> coordinate(-40000 * resolution_m, 40000 * resolution_m);
    for (int i = 0; i < 20000; ++i) {
      const double at = i % 2 == 0 ? coordinate(random) : std::round(coordinate(random) * 20) / 20;
      octomap::key_type theirs = 0;
      const bool inside = octomap_tree.coordToKeyChecked(at, theirs);
      const auto ours = grid.key(at);
      ASSERT_EQ(ours.has_value(), inside) << at;
      if (!inside) continue;
      ASSERT_EQ(*ours, theirs) << at;
      ASSERT_EQ(grid.centre_m(*ours), octomap_tree.keyToCoord(theirs));
    }
  }
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_key.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace hypermap {
namespace {

/// Bit by bit.
std::uint64_t interleaved(const VoxelKey& key) {
  std::uint64_t code = 0;
  for (unsigned bit = 0; bit < 16; ++bit) {
    code |= static_cast<std::uint64_t>((key.x >> bit) & 1U) << (3 * bit);
    code |= static_cast<std::uint64_t>((key.y >> bit) & 1U) << (3 * bit + 1);
    code |= static_cast<std::uint64_t>((key.z >> bit) & 1U) << (3 * bit + 2);
  }
  return code;
}

TEST(VoxelKey, MortonCodeInterleavesTheBits) {
  // x = 5 = 101b -> bits 0 and 6; y = 3 = 011b -> bits 1 and 4; z = 2 = 010b -> bit 5:
  // 1 + 64 + 2 + 16 + 32 = 115.
  EXPECT_EQ((VoxelKey{5, 3, 2}.morton()), 115U);
  EXPECT_EQ((VoxelKey{65535, 65535, 65535}.morton()), (std::uint64_t{1} << 48U) - 1);
}

TEST(VoxelKey, MortonCodeAndBackAreInversesForEveryValueOfAnAxis) {
  for (std::uint32_t value = 0; value < 65536; ++value) {
    const auto axis = static_cast<std::uint16_t>(value);
    const VoxelKey key{axis, static_cast<std::uint16_t>(~axis), 4711};
    ASSERT_EQ(key.morton(), interleaved(key));
    ASSERT_EQ(VoxelKey::from_morton(key.morton()), key);
  }
}

TEST(VoxelKey, KeysAreOrderedByTheirMortonCode) {
  std::mt19937 random(1);
  std::vector<VoxelKey> keys(1000);
  for (VoxelKey& key : keys) {
    key = {static_cast<std::uint16_t>(random()),
           static_cast<std::uint16_t>(random()),
           static_cast<std::uint16_t>(random())};
  }
  std::sort(keys.begin(), keys.end());
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end(), [](const auto& a, const auto& b) {
    return interleaved(a) < interleaved(b);
  }));
}

TEST(BrickKey, VoxelsOfABrickFollowEachOther) {
  const VoxelKey voxel{32771, 40001, 12};
  const BrickKey brick = BrickKey::of(voxel);
  EXPECT_EQ(brick.corner(), (VoxelKey{32768, 40000, 8}));
  EXPECT_EQ(brick.voxel(cell_in_brick(voxel)), voxel);
  for (std::size_t cell = 0; cell < kBrickVolume; ++cell) {
    ASSERT_EQ(BrickKey::of(brick.voxel(cell)), brick);
    ASSERT_EQ(cell_in_brick(brick.voxel(cell)), cell);
    ASSERT_EQ(voxel_in_brick(brick.corner(), cell), brick.voxel(cell));
    ASSERT_TRUE(in_one_brick(brick.voxel(cell), voxel));
  }
}

TEST(BrickKey, VoxelsBesideABrickAreInAnother) {
  // 8 to 15 along each axis is one brick; one step out along any axis is another, and 65,535 is as
  // far from 0 as it can be, not beside it.
  for (const VoxelKey& outside : {VoxelKey{7, 8, 8},
                                  VoxelKey{16, 8, 8},
                                  VoxelKey{8, 7, 15},
                                  VoxelKey{15, 16, 8},
                                  VoxelKey{8, 15, 7},
                                  VoxelKey{15, 15, 16}}) {
    EXPECT_FALSE(in_one_brick(outside, {8, 8, 8}));
    EXPECT_NE(BrickKey::of(outside), BrickKey::of({8, 8, 8}));
  }
  EXPECT_FALSE(in_one_brick({65535, 0, 0}, {0, 0, 0}));
}

}  // namespace
}  // namespace hypermap

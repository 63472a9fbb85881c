// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/cutaway.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// A room of voxels of 0.1 m: floor from 0 to 0.1, four walls, ceiling at `height_m`; 4 m x 3 m.
std::vector<OccupiedVoxel> room(double height_m) {
  std::vector<OccupiedVoxel> voxels;
  const int top = static_cast<int>(std::lround(height_m * 10.0));
  for (int z = 0; z <= top; ++z) {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 40; ++x) {
        const bool wall = x == 0 || y == 0 || x == 39 || y == 29;
        if (z != 0 && z != top && !wall) continue;
        const Eigen::Vector3d centre = 0.1 * (Eigen::Vector3d(x, y, z).array() + 0.5);
        voxels.push_back({centre.cast<float>(), 0.1F});
      }
    }
  }
  return voxels;
}

bool any_in(const std::vector<OccupiedVoxel>& voxels,
            const Eigen::Vector3f& low,
            const Eigen::Vector3f& high) {
  return std::any_of(voxels.begin(), voxels.end(), [&](const OccupiedVoxel& voxel) {
    return (voxel.centre_in_map.array() >= low.array()).all() &&
           (voxel.centre_in_map.array() <= high.array()).all();
  });
}

TEST(Cutaway, TheFloorIsTheLowestFullLevel) {
  auto voxels = room(2.5);
  EXPECT_NEAR(floor_height_m(voxels), 0.0, 1e-6);
  voxels.push_back({Eigen::Vector3f(1, 1, -3), 0.1F});  // a stray voxel below
  EXPECT_NEAR(floor_height_m(voxels), 0.0, 1e-6);
  EXPECT_EQ(floor_height_m({}), 0.0);
}

TEST(Cutaway, AHighRoomIsCutAtTheUsualHeight) {
  EXPECT_DOUBLE_EQ(ceiling_cut_m(room(2.8), 0.0), 2.2);
}

// The ceiling's voxels begin at 2.0; one voxel below that is 1.9.
TEST(Cutaway, ALowCeilingIsCutBelow) {
  EXPECT_NEAR(ceiling_cut_m(room(2.0), 0.0), 1.9, 1e-6);
}

TEST(Cutaway, WhatHasNoCeilingIsNotCut) {
  auto voxels = room(2.0);
  std::erase_if(voxels, [](const OccupiedVoxel& voxel) { return voxel.centre_in_map.z() > 1.5F; });
  EXPECT_TRUE(std::isinf(ceiling_cut_m(voxels, 0.0)));
}

TEST(Cutaway, NothingHigherThanTheCutStays) {
  const auto low = cut_away(room(2.5), {.cut_above_m = 1.0});
  EXPECT_FALSE(any_in(low, {0, 0, 1.01F}, {4, 3, 9}));
  EXPECT_TRUE(any_in(low, {0, 0, 0.9F}, {4, 3, 1.0F}));
}

// The eye is in the south: the wall at y = 0 goes, but for its stump; the one at y = 2.9 stays.
TEST(Cutaway, TheWallBeforeTheRoomIsCutLowAndTheFarOneStays) {
  const auto seen =
      cut_away(room(2.5), {.cut_above_m = 2.2, .towards_eye = Eigen::Vector2d(0, -1)});
  EXPECT_FALSE(any_in(seen, {0.2F, 0, 0.3F}, {3.8F, 0.1F, 9}));
  EXPECT_TRUE(any_in(seen, {0.2F, 0, 0.1F}, {3.8F, 0.1F, 0.25F}));
  EXPECT_TRUE(any_in(seen, {0.2F, 2.9F, 2.0F}, {3.8F, 3.0F, 2.2F}));
}

TEST(Cutaway, LabelledVoxelsAreNotTakenForWalls) {
  auto voxels = room(2.5);
  for (OccupiedVoxel& voxel : voxels) voxel.class_id = ClassId{1};
  const auto seen = cut_away(voxels, {.cut_above_m = 9.0, .towards_eye = Eigen::Vector2d(0, -1)});
  EXPECT_EQ(seen.size(), voxels.size());
}

TEST(Cutaway, AWallWithoutARoomBehindItStays) {
  auto voxels = room(2.5);
  std::erase_if(voxels, [](const OccupiedVoxel& voxel) { return voxel.centre_in_map.y() > 0.9F; });
  const auto seen = cut_away(voxels, {.cut_above_m = 9.0, .towards_eye = Eigen::Vector2d(0, -1)});
  EXPECT_EQ(seen.size(), voxels.size());
}

TEST(Cutaway, NothingOfNothing) {
  EXPECT_TRUE(cut_away({}, {}).empty());
}

}  // namespace
}  // namespace hypermap

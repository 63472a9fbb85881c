// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/sky_light.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

constexpr float kEdgeM = 0.1F;

/// A floor of 4 m x 4 m with its upper side at 0, and a wall of 2 m along x = 0.
std::vector<OccupiedVoxel> floor_with_wall() {
  std::vector<OccupiedVoxel> voxels;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      voxels.push_back({kEdgeM * Eigen::Vector3f(float(x) + 0.5F, float(y) + 0.5F, -0.5F), kEdgeM});
    }
    voxels.push_back({{0.5F * kEdgeM, kEdgeM * (float(y) + 0.5F), 1.95F}, kEdgeM});
  }
  return voxels;
}

TEST(SkyLight, ReachesAllOfAnOpenPlain) {
  const SkyLight light(floor_with_wall());
  EXPECT_FLOAT_EQ(light.at({3.0F, 2.0F, 0.05F}, FaceDirection::kUp), 1.0F);
  EXPECT_FLOAT_EQ(SkyLight({}).at({0, 0, 0}, FaceDirection::kUp), 1.0F);
}

TEST(SkyLight, FadesTowardsAWall) {
  const SkyLight light(floor_with_wall());
  float last = 0.0F;
  for (const float x : {0.15F, 0.25F, 0.45F, 0.75F, 1.25F}) {
    const float here = light.at({x, 2.0F, 0.05F}, FaceDirection::kUp);
    EXPECT_GE(here, last) << x;
    last = here;
  }
  EXPECT_FLOAT_EQ(last, 1.0F);
  EXPECT_LT(light.at({0.15F, 2.0F, 0.05F}, FaceDirection::kUp), 0.8F);
}

// The wall's own face looks away from the wall, into the open.
TEST(SkyLight, UprightFacesLookToOneSide) {
  const SkyLight light(floor_with_wall());
  EXPECT_FLOAT_EQ(light.at({0.15F, 2.0F, 1.0F}, FaceDirection::kEast), 1.0F);
  EXPECT_LT(light.at({0.15F, 2.0F, 1.0F}, FaceDirection::kWest), 0.5F);
}

TEST(SkyLight, UnderATableIsDark) {
  auto voxels = floor_with_wall();
  for (int y = 10; y < 30; ++y) {
    for (int x = 10; x < 30; ++x) {
      voxels.push_back({kEdgeM * Eigen::Vector3f(float(x) + 0.5F, float(y) + 0.5F, 7.5F), kEdgeM});
    }
  }
  const SkyLight light(voxels);
  EXPECT_LT(light.at({2.0F, 2.0F, 0.05F}, FaceDirection::kUp), 0.1F);
  EXPECT_FLOAT_EQ(light.at({2.0F, 2.0F, 0.85F}, FaceDirection::kUp), 1.0F);  // on the table
}

TEST(SkyLight, ALargeMapIsPlannedInLargerCells) {
  const std::vector<OccupiedVoxel> voxels{{{-5000, -5000, 0}, kEdgeM}, {{5000, 5000, 0}, kEdgeM}};
  EXPECT_FLOAT_EQ(SkyLight(voxels).at({0, 0, 1}, FaceDirection::kUp), 1.0F);
}

}  // namespace
}  // namespace hypermap

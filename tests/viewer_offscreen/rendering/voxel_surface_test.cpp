// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/rendering/voxel_surface.hpp"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>
#include <tuple>

namespace hypermap {
namespace {

using enum FaceDirection;
constexpr std::array<FaceDirection, 6> kAllDirections{kEast, kWest, kNorth, kSouth, kUp, kDown};

/// A voxel of 0.1 m by its cell.
OccupiedVoxel voxel(int x, int y, int z) {
  const Eigen::Vector3d centre = 0.1 * (Eigen::Vector3d(x, y, z).array() + 0.5);
  return {centre.cast<float>(), 0.1F};
}

std::vector<VoxelFace> all_faces(const std::vector<OccupiedVoxel>& voxels) {
  return exposed_faces(voxels, kAllDirections).value();
}

TEST(VoxelSurface, OccupiedLeavesAreTaken) {
  const auto leaves = [](const LeafVisitor& visit) {
    LeafSample leaf;
    leaf.edge_m = 0.05;
    visit(leaf);  // free
    leaf.occupied = true;
    leaf.best_class = ClassId{3};
    visit(leaf);
    leaf.centre_in_map.x() = std::numeric_limits<double>::quiet_NaN();
    visit(leaf);  // nowhere
  };
  const auto voxels = occupied_voxels(leaves);
  ASSERT_EQ(voxels.size(), 1U);
  EXPECT_EQ(voxels[0].class_id, ClassId{3});
  EXPECT_TRUE(occupied_voxels(nullptr).empty());
}

TEST(VoxelSurface, FaceAxesTurnTowardsTheNormal) {
  for (const FaceDirection direction : kAllDirections) {
    const FaceAxes axes = axes_of(direction);
    EXPECT_EQ(axes.first.cross(axes.second), normal_of(direction));
  }
}

TEST(VoxelSurface, ALoneVoxelHasSixOpenFaces) {
  const auto faces = all_faces({voxel(0, 0, 0)});
  ASSERT_EQ(faces.size(), 6U);
  for (const VoxelFace& face : faces) {
    EXPECT_THAT(face.openness, testing::Each(3));
  }
}

TEST(VoxelSurface, TouchingVoxelsHideTheFacesBetweenThem) {
  EXPECT_EQ(all_faces({voxel(0, 0, 0), voxel(1, 0, 0)}).size(), 10U);
  EXPECT_EQ(all_faces({voxel(-1, 0, 0), voxel(0, 0, 0)}).size(), 10U);  // across zero
}

// East of the floor's voxel stands a wall of one voxel: of its upper face the two corners at the
// wall have one side neighbour, and the wall's diagonal neighbours are empty: 3 - 1 = 2.
TEST(VoxelSurface, CornersAtAWallAreLessOpen) {
  const auto faces = all_faces({voxel(0, 0, 0), voxel(1, 0, 1)});
  for (const VoxelFace& face : faces) {
    if (face.voxel_index != 0 || face.direction != kUp) continue;
    EXPECT_THAT(face.openness, testing::ElementsAre(3, 2, 3, 2));  // (k & 1): the east side
  }
}

TEST(VoxelSurface, ACornerBetweenTwoWallsIsClosed) {
  const auto faces = all_faces({voxel(0, 0, 0), voxel(1, 0, 1), voxel(0, 1, 1)});
  for (const VoxelFace& face : faces) {
    if (face.voxel_index != 0 || face.direction != kUp) continue;
    EXPECT_EQ(face.openness[3], 0);  // north-east
  }
}

// Brute force: a face is bare when the set does not hold the neighbour.
TEST(VoxelSurface, AgreesWithALookAtEveryNeighbour) {
  std::mt19937 random(5);
  std::set<std::tuple<int, int, int>> cells;
  while (cells.size() < 400) {
    const auto place = [&] { return static_cast<int>(random() % 12U) - 6; };
    const int x = place();
    const int y = place();
    cells.insert({x, y, place()});
  }
  std::vector<OccupiedVoxel> voxels;
  std::size_t num_bare = 0;
  for (const auto& [x, y, z] : cells) {
    voxels.push_back(voxel(x, y, z));
    for (const FaceDirection direction : kAllDirections) {
      const Eigen::Vector3i next = Eigen::Vector3i(x, y, z) + normal_of(direction).cast<int>();
      num_bare += cells.count({next.x(), next.y(), next.z()}) == 0 ? 1U : 0U;
    }
  }
  EXPECT_EQ(all_faces(voxels).size(), num_bare);
}

TEST(VoxelSurface, LargerVoxelsKeepAllFaces) {
  const OccupiedVoxel large{Eigen::Vector3f(0.1F, 0.1F, 0.3F), 0.2F};
  EXPECT_EQ(all_faces({voxel(0, 0, 1), large}).size(), 12U);
}

TEST(VoxelSurface, OnlyTheDirectionsAskedForAreGiven) {
  const std::vector<OccupiedVoxel> voxels{voxel(0, 0, 0)};
  const std::array<FaceDirection, 1> up{kUp};
  EXPECT_EQ(exposed_faces(voxels, up).value().size(), 1U);
  EXPECT_TRUE(exposed_faces({}, up).value().empty());
}

}  // namespace
}  // namespace hypermap

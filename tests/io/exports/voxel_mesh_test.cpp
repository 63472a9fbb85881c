// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_mesh.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

namespace hypermap {
namespace {

/// A unit face by its axis, the side it looks to, its lower corner and its colour.
using UnitFace = std::tuple<int, bool, LatticePoint, std::uint32_t>;

/// What has to be covered, voxel by voxel.
std::multiset<UnitFace> exposed_unit_faces(const std::vector<ColoredVoxel>& voxels) {
  std::set<LatticePoint> there;
  for (const ColoredVoxel& voxel : voxels) there.insert(voxel.low);
  std::multiset<UnitFace> faces;
  for (const ColoredVoxel& voxel : voxels) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool faces_high : {false, true}) {
        LatticePoint beyond = voxel.low;
        beyond.at(static_cast<std::size_t>(axis)) += faces_high ? 1 : -1;
        if (there.contains(beyond)) continue;
        LatticePoint corner = voxel.low;
        corner.at(static_cast<std::size_t>(axis)) += faces_high ? 1 : 0;
        faces.insert({axis, faces_high, corner, voxel.color});
      }
    }
  }
  return faces;
}

std::multiset<UnitFace> covered_unit_faces(const std::vector<FaceRectangle>& rectangles) {
  std::multiset<UnitFace> faces;
  for (const FaceRectangle& rectangle : rectangles) {
    const auto axis = static_cast<std::size_t>(rectangle.axis);
    EXPECT_EQ(rectangle.low.at(axis), rectangle.high.at(axis));
    LatticePoint end = rectangle.high;
    ++end.at(axis);
    for (int x = rectangle.low[0]; x < end[0]; ++x) {
      for (int y = rectangle.low[1]; y < end[1]; ++y) {
        for (int z = rectangle.low[2]; z < end[2]; ++z) {
          faces.insert({rectangle.axis, rectangle.faces_high, {x, y, z}, rectangle.color});
        }
      }
    }
  }
  return faces;
}

std::vector<ColoredVoxel> random_voxels(unsigned seed, double share, std::uint32_t num_colors) {
  std::mt19937 random(seed);
  std::bernoulli_distribution is_there(share);
  std::uniform_int_distribution<std::uint32_t> color(0, num_colors - 1);
  std::vector<ColoredVoxel> voxels;
  for (int x = -3; x < 4; ++x) {
    for (int y = -2; y < 6; ++y) {
      for (int z = 1000; z < 1005; ++z) {
        if (is_there(random)) voxels.push_back({{x, y, z}, color(random)});
      }
    }
  }
  std::shuffle(voxels.begin(), voxels.end(), random);
  return voxels;
}

TEST(VoxelMesh, EachExposedFaceIsCoveredOnceAndNoOther) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const auto voxels = random_voxels(seed, 0.1 + 0.03 * seed, 1 + seed % 3);
    EXPECT_EQ(covered_unit_faces(merged_faces(voxels)), exposed_unit_faces(voxels)) << seed;
  }
}

// A block of 3 x 2 x 4 voxels: six rectangles, whatever it is made of.
TEST(VoxelMesh, ABlockIsSixRectangles) {
  std::vector<ColoredVoxel> voxels;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 2; ++y) {
      for (int z = 0; z < 4; ++z) voxels.push_back({{x, y, z}, 7});
    }
  }
  const auto rectangles = merged_faces(voxels);
  ASSERT_EQ(rectangles.size(), 6U);
  EXPECT_EQ(rectangles[1],
            (FaceRectangle{
                .color = 7, .axis = 0, .faces_high = true, .low = {3, 0, 0}, .high = {3, 2, 4}}));
  EXPECT_EQ(mesh_of(rectangles).points.size(), 8U);
  EXPECT_EQ(mesh_of(rectangles).triangles.size(), 36U);
}

// Two voxels side by side: the two long sides, top and bottom break where the colour changes.
TEST(VoxelMesh, ColoursStayApart) {
  EXPECT_EQ(merged_faces(std::vector<ColoredVoxel>{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}}).size(), 6U);
  EXPECT_EQ(merged_faces(std::vector<ColoredVoxel>{{{0, 0, 0}, 1}, {{1, 0, 0}, 2}}).size(), 10U);
}

TEST(VoxelMesh, NothingHasNoFaces) {
  EXPECT_TRUE(merged_faces({}).empty());
  EXPECT_TRUE(mesh_of({}).points.empty());
  EXPECT_TRUE(mesh_of({}).triangles.empty());
}

// By the divergence theorem a closed surface of outward triangles spans sum(a . (b x c)) / 6.
TEST(VoxelMesh, TrianglesAreWoundOutwards) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const auto voxels = random_voxels(seed, 0.4, 2);
    const LatticeMesh mesh = mesh_of(merged_faces(voxels));
    std::int64_t six_volumes = 0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) {
      const auto corner = [&](std::size_t k) {
        const LatticePoint& point = mesh.points.at(mesh.triangles.at(i + k));
        return std::array<std::int64_t, 3>{point[0], point[1], point[2]};
      };
      const auto a = corner(0);
      const auto b = corner(1);
      const auto c = corner(2);
      six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]);
    }
    EXPECT_EQ(six_volumes, 6 * static_cast<std::int64_t>(voxels.size())) << seed;
  }
}

TEST(VoxelMesh, NoPointStandsTwice) {
  const LatticeMesh mesh = mesh_of(merged_faces(random_voxels(3, 0.5, 2)));
  const std::set<LatticePoint> points(mesh.points.begin(), mesh.points.end());
  EXPECT_EQ(points.size(), mesh.points.size());
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/occlusion/occlusion_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace hypermap {
namespace {

constexpr double kEdge = 0.1;
constexpr MilliLogOdds kOccupied = 847;
constexpr MilliLogOdds kFree = -405;

SemanticOctree tree_of(const std::vector<VoxelKey>& occupied) {
  auto tree = SemanticOctree::create({.resolution_m = kEdge}).value();
  for (const VoxelKey& key : occupied) {
    EXPECT_TRUE(tree.set_leaf({.key = key, .log_odds = kOccupied}));
  }
  return tree;
}

OcclusionScene scene_of(const SemanticOctree& tree, std::size_t max_lanes = 16) {
  auto scene = OcclusionScene::create(max_lanes).value();
  EXPECT_TRUE(scene.update(tree));
  return scene;
}

/// Voxels in clumps, so that bricks are full, sparse and single.
std::vector<VoxelKey> random_voxels(std::mt19937& random) {
  std::vector<VoxelKey> voxels;
  for (int clump = 0; clump < 12; ++clump) {
    const auto centre = [&random] { return 32738 + static_cast<int>(random() % 60); };
    const int x = centre();
    const int y = centre();
    const int z = centre();
    const int size = 1 + static_cast<int>(random() % 12);
    for (int i = 0; i < size * 8; ++i) {
      const auto near = [&](int at) {
        return static_cast<std::uint16_t>(at +
                                          static_cast<int>(random() % static_cast<unsigned>(size)));
      };
      voxels.push_back({near(x), near(y), near(z)});
    }
  }
  return voxels;
}

/// Whether a segment meets any voxel, each grown by `grown` on all sides; by the slabs of its axes.
bool intersects_any(const std::vector<Eigen::Vector3d>& centres,
                    const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to,
                    double margin_m,
                    double grown) {
  const Eigen::Vector3d way = to - from;
  const double end = 1.0 - margin_m / way.norm();
  return std::any_of(centres.begin(), centres.end(), [&](const Eigen::Vector3d& centre) {
    double first = 0.0;
    double last = end;
    for (int i = 0; i < 3; ++i) {
      const double half = kEdge / 2 + grown;
      if (way[i] == 0.0) {
        if (std::abs(from[i] - centre[i]) > half) return false;
        continue;
      }
      double a = (centre[i] - half - from[i]) / way[i];
      double b = (centre[i] + half - from[i]) / way[i];
      if (a > b) std::swap(a, b);
      first = std::max(first, a);
      last = std::min(last, b);
    }
    return first <= last;
  });
}

TEST(OcclusionScene, NothingHidesAnythingInAnEmptyScene) {
  const auto scene = OcclusionScene::create().value();
  EXPECT_FALSE(scene.occluded({{{0, 0, 0}}, {{5, 5, 5}}, 0.0}));
  EXPECT_EQ(scene.num_bricks(), 0U);
}

TEST(OcclusionScene, AgreesWithALookAtEveryVoxel) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> within(-3.2, 3.6);
  int num_occluded = 0;
  for (int round = 0; round < 6; ++round) {
    const SemanticOctree tree = tree_of(random_voxels(random));
    const OcclusionScene scene = scene_of(tree);
    std::vector<Eigen::Vector3d> centres;
    tree.for_each_leaf([&](const LeafSample& leaf) { centres.push_back(leaf.centre_in_map); });
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d from(within(random), within(random), within(random));
      const Eigen::Vector3d to(within(random), within(random), within(random));
      const double margin_m = i % 3 == 0 ? 0.3 : 0.0;
      if ((to - from).norm() <= margin_m) continue;
      const bool occluded = scene.occluded({{from}, {to}, margin_m});
      num_occluded += occluded ? 1 : 0;
      // Within a thousandth of a voxel of an edge, either answer is right.
      if (intersects_any(centres, from, to, margin_m, -1e-3 * kEdge)) {
        ASSERT_TRUE(occluded) << from.transpose() << " to " << to.transpose();
      } else if (!intersects_any(centres, from, to, margin_m, 1e-3 * kEdge)) {
        ASSERT_FALSE(occluded) << from.transpose() << " to " << to.transpose();
      }
    }
  }
  EXPECT_GT(num_occluded, 1000);
}

TEST(OcclusionScene, LinesAlongAxesThroughVoxelsNearTheEdgesOfBricksAreNotMissed) {
  for (const auto at : std::initializer_list<std::uint16_t>{32767, 32768, 32775, 32776}) {
    const VoxelKey key{at, at, at};
    const SemanticOctree tree = tree_of({key});
    const OcclusionScene scene = scene_of(tree);
    const Eigen::Vector3d centre = tree.grid().centre(key).xyz;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        // Everywhere over the face of the voxel, close to its edges too.
        for (const double u : {-0.499, -0.25, 0.0, 0.499}) {
          for (const double v : {-0.499, 0.0, 0.3, 0.499}) {
            Eigen::Vector3d target = centre;
            target[(axis + 1) % 3] += u * kEdge;
            target[(axis + 2) % 3] += v * kEdge;
            const Eigen::Vector3d way = sign * Eigen::Vector3d::Unit(axis);
            EXPECT_TRUE(scene.occluded({{target - 2.0 * way}, {target + 2.0 * way}, 0.0}));
            EXPECT_FALSE(scene.occluded({{target - 2.0 * way}, {target - 0.06 * way}, 0.0}));
          }
        }
      }
    }
  }
}

TEST(OcclusionScene, NothingIsSeenThroughTheSeamsBetweenBricks) {
  std::mt19937 random(47);
  std::uniform_real_distribution<double> within(-2.0, 2.0);
  // A wall of one voxel's thickness in each layer of its bricks, and lines through the edges and
  // corners where bricks meet: every 0.8 m.
  for (std::uint16_t layer = 32768; layer < 32776; ++layer) {
    std::vector<VoxelKey> wall;
    for (std::uint16_t y = 32728; y < 32808; ++y) {
      for (std::uint16_t z = 32728; z < 32808; ++z) wall.push_back({layer, y, z});
    }
    const SemanticOctree tree = tree_of(wall);
    const OcclusionScene scene = scene_of(tree);
    const double x = (layer - 32768 + 0.5) * kEdge;
    for (int i = 0; i < 500; ++i) {
      const Eigen::Vector3d seam(
          x, 0.8 * (static_cast<int>(random() % 5) - 2), i % 2 == 0 ? 0.0 : within(random));
      const Eigen::Vector3d way(0.5 + std::abs(within(random)), within(random), within(random));
      EXPECT_TRUE(scene.occluded({{seam - way}, {seam + way}, 0.0})) << seam.transpose();
      EXPECT_FALSE(scene.occluded({{seam - way}, {seam - 0.2 * way}, 0.0})) << seam.transpose();
    }
  }
}

TEST(OcclusionScene, ALineOnTheFaceOfAWallIsHidden) {
  // A wall of two voxels' thickness around the plane x = 0: whichever side the line counts to.
  std::vector<VoxelKey> wall;
  for (std::uint16_t y = 32750; y < 32790; ++y) {
    for (std::uint16_t z = 32750; z < 32790; ++z) {
      wall.push_back({32767, y, z});
      wall.push_back({32768, y, z});
    }
  }
  const SemanticOctree tree = tree_of(wall);
  const OcclusionScene scene = scene_of(tree);
  EXPECT_TRUE(scene.occluded({{{0.0, -1.0, 0.0}}, {{0.0, 1.0, 0.0}}, 0.0}));
  EXPECT_TRUE(scene.occluded({{{0.0, -3.0, 0.05}}, {{0.0, 3.0, 0.05}}, 0.0}));
}

TEST(OcclusionScene, TheMarginSparesTheThingItself) {
  const SemanticOctree tree = tree_of({{32778, 32768, 32768}});  // x from 1.0 to 1.1
  const OcclusionScene scene = scene_of(tree);
  const PointInMap from{{0.05, 0.05, 0.05}};
  const PointInMap within{{1.05, 0.05, 0.05}};
  const PointInMap inside{{1.02, 0.05, 0.05}};
  EXPECT_FALSE(scene.occluded({inside, {{1.12, 0.05, 0.05}}, 1.12 - 1.02})) << "just as long";
  EXPECT_TRUE(scene.occluded({from, within, 0.0}));
  EXPECT_TRUE(scene.occluded({from, within, 0.04}));
  EXPECT_FALSE(scene.occluded({from, within, 0.06}));
  EXPECT_FALSE(scene.occluded({from, within, 2.0}));
}

TEST(OcclusionScene, AStartInsideAVoxelIsOccludedAndNonsenseIsNot) {
  const SemanticOctree tree = tree_of({{32768, 32768, 32768}});
  const OcclusionScene scene = scene_of(tree);
  const PointInMap inside{{0.05, 0.05, 0.05}};
  EXPECT_TRUE(scene.occluded({inside, {{2.0, 0.05, 0.05}}, 0.0}));
  EXPECT_FALSE(scene.occluded({inside, inside, 0.0}));
  EXPECT_FALSE(scene.occluded({inside, {{std::nan(""), 0, 0}}, 0.0}));
  EXPECT_FALSE(
      scene.occluded({{{std::numeric_limits<double>::infinity(), 0, 0}}, {{0, 0, 0}}, 0.0}));
  EXPECT_FALSE(scene.occluded({{{-1e200, 0.05, 0.05}}, {{2.0, 0.05, 0.05}}, 0.0}));
}

TEST(OcclusionScene, LinesFromOneCameraFindTheirOwnAnswersInAnyOrder) {
  std::mt19937 random(59);
  std::uniform_real_distribution<double> within(-3.0, 3.0);
  const SemanticOctree tree = tree_of(random_voxels(random));
  const PointInMap camera{{0.03, -3.4, 0.02}};
  for (const std::size_t num_rays : {1U, 3U, 15U, 17U, 63U, 64U, 65U, 1000U}) {
    std::vector<OcclusionRay> rays(num_rays);
    for (OcclusionRay& ray : rays) {
      ray = {camera, {{within(random), within(random), within(random)}}, 0.1};
    }
    for (const std::size_t max_lanes : {4U, 8U, 16U}) {
      const OcclusionScene scene = scene_of(tree, max_lanes);
      std::vector<std::uint8_t> expected(rays.size());
      for (std::size_t i = 0; i < rays.size(); ++i) expected[i] = scene.occluded(rays[i]) ? 1 : 0;
      EXPECT_EQ(scene.occluded(rays), expected) << num_rays << " lines, " << max_lanes;
    }
  }
}

TEST(OcclusionScene, ALineThatCannotBeHiddenDoesNotDisturbItsNeighbours) {
  const SemanticOctree tree = tree_of({{32778, 32768, 32768}});  // x from 1.0 to 1.1
  const OcclusionScene scene = scene_of(tree);
  const PointInMap from{{0.05, 0.05, 0.05}};
  const OcclusionRay hidden{from, {{2.0, 0.05, 0.05}}, 0.0};
  const OcclusionRay nonsense{from, {{std::nan(""), 0, 0}}, 0.0};
  const OcclusionRay too_short{from, {{2.0, 0.05, 0.05}}, 5.0};
  const OcclusionRay open{from, {{-2.0, 0.05, 0.05}}, 0.0};
  const std::vector<OcclusionRay> rays{nonsense, hidden, too_short, hidden, open, nonsense, hidden};
  EXPECT_EQ(scene.occluded(rays), (std::vector<std::uint8_t>{0, 1, 0, 1, 0, 0, 1}));
  EXPECT_EQ(scene.occluded(std::vector{nonsense, too_short}), (std::vector<std::uint8_t>{0, 0}));
}

TEST(OcclusionScene, FollowsTheTreeByItsChangedBricks) {
  auto tree = tree_of({{32768, 32768, 32768}, {32900, 32768, 32768}});
  auto scene = scene_of(tree);
  EXPECT_EQ(scene.num_bricks(), 2U);
  EXPECT_EQ(scene.update(tree).value(), 0U) << "nothing changed";
  const PointInMap from{{-1.0, 0.05, 0.05}};
  const PointInMap to{{1.0, 0.05, 0.05}};
  EXPECT_TRUE(scene.occluded({from, to, 0.0}));
  ASSERT_TRUE(tree.set_leaf({.key = {32768, 32768, 32768}, .log_odds = kFree}));
  EXPECT_EQ(scene.update(tree).value(), 1U) << "one brick changed";
  EXPECT_FALSE(scene.occluded({from, to, 0.0}));
  ASSERT_TRUE(tree.set_leaf({.key = {32774, 32768, 32768}, .log_odds = kOccupied}));
  EXPECT_EQ(scene.update(tree).value(), 1U);
  EXPECT_TRUE(scene.occluded({from, to, 0.0}));
}

TEST(OcclusionScene, ManyLinesGetTheSameAnswersAsOneByOneOnAnyNumberOfThreads) {
  std::mt19937 random(43);
  std::uniform_real_distribution<double> within(-3.0, 3.0);
  const SemanticOctree tree = tree_of(random_voxels(random));
  const OcclusionScene scene = scene_of(tree);
  std::vector<OcclusionRay> rays(5000);
  std::vector<std::uint8_t> expected;
  for (OcclusionRay& ray : rays) {
    ray.from.xyz = {within(random), within(random), within(random)};
    ray.to.xyz = {within(random), within(random), within(random)};
    ray.margin_m = 0.1;
    expected.push_back(scene.occluded(ray) ? 1 : 0);
  }
  EXPECT_EQ(scene.occluded(rays, 1), expected);
  EXPECT_EQ(scene.occluded(rays, 2), expected);
  EXPECT_TRUE(scene.occluded(std::span<const OcclusionRay>{}).empty());
}

TEST(OcclusionScene, LinesToOneThingAreAnsweredAsIfEachWereAlone) {
  std::mt19937 random(53);
  std::uniform_real_distribution<double> within(-3.0, 3.0);
  std::uniform_real_distribution<double> beside(-0.3, 0.3);
  const SemanticOctree tree = tree_of(random_voxels(random));
  const OcclusionScene scene = scene_of(tree);
  std::vector<OcclusionRay> rays;
  std::vector<std::uint8_t> expected;
  // More than are followed together, and no multiple of it.
  constexpr int kRaysPerObject = 70;
  for (int object = 0; object < 200; ++object) {
    const Eigen::Vector3d camera(within(random), within(random), within(random));
    const Eigen::Vector3d centre(within(random), within(random), within(random));
    for (int i = 0; i < kRaysPerObject; ++i) {
      const Eigen::Vector3d offset(beside(random), beside(random), beside(random));
      rays.push_back({{camera}, {centre + offset}, 0.1});
      expected.push_back(scene.occluded(rays.back()) ? 1 : 0);
    }
  }
  EXPECT_EQ(scene.occluded(rays, 1), expected);
  EXPECT_EQ(scene.occluded(rays, 3), expected);
  EXPECT_EQ(scene_of(tree, 8).occluded(rays), expected) << "eight at a time";
  EXPECT_EQ(scene_of(tree, 4).occluded(rays), expected) << "four at a time";
  EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 500);
  EXPECT_GT(std::count(expected.begin(), expected.end(), 0), 500);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <random>

namespace hypermap {
namespace {

constexpr double kEdge = 0.1;
constexpr MilliLogOdds kOccupied = 847;
constexpr MilliLogOdds kFree = -405;

SemanticOctree tree_of(const std::vector<StoredLeaf>& leaves) {
  return SemanticOctree::from_leaves({.resolution_m = kEdge}, leaves).value();
}

/// Where a line enters a closed box, by the slabs of its axes.
std::optional<double> entry(const Eigen::Vector3d& centre,
                            const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction) {
  double first = 0.0;
  double last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    double a = (centre[i] - kEdge / 2 - origin[i]) / direction[i];
    double b = (centre[i] + kEdge / 2 - origin[i]) / direction[i];
    if (a > b) std::swap(a, b);
    first = std::max(first, a);
    last = std::min(last, b);
  }
  return first <= last ? std::optional(first) : std::nullopt;
}

TEST(RayCast, FindsTheNearestOfRandomVoxelsAsALookAtAllDoes) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> within(-1.6, 1.6);
  const auto axis = [&random] { return static_cast<std::uint16_t>(32752 + random() % 32); };
  std::vector<StoredLeaf> leaves;
  SemanticOctree tree = tree_of({});
  for (int i = 0; i < 400; ++i) {
    const StoredLeaf leaf{.key = {axis(), axis(), axis()},
                          .log_odds = random() % 4 == 0 ? kFree : kOccupied};
    ASSERT_TRUE(tree.set_leaf(leaf));
  }
  int num_hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d origin(within(random), within(random), within(random));
    const Eigen::Vector3d direction =
        Eigen::Vector3d(within(random), within(random), within(random)).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    tree.for_each_leaf([&](const LeafSample& leaf) {
      if (!leaf.occupied) return;
      nearest = std::min(nearest, entry(leaf.centre_in_map, origin, direction).value_or(nearest));
    });
    const RayCast cast = tree.cast_ray({origin}, 3.0 * direction, {.max_range_m = 100.0});
    ASSERT_EQ(cast.outcome == RayCast::Outcome::kHit, std::isfinite(nearest));
    if (!std::isfinite(nearest)) continue;
    ++num_hits;
    EXPECT_NEAR(cast.distance_m, nearest, 1e-9);
    EXPECT_TRUE(tree.at(cast.key)->occupied);
  }
  EXPECT_GT(num_hits, 500);
}

TEST(RayCast, RunsAlongEachAxisBothWays) {
  const SemanticOctree tree = tree_of({{.key = {32768, 32768, 32768}, .log_odds = kOccupied}});
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Eigen::Vector3d direction = sign * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d origin = Eigen::Vector3d::Constant(0.05) - 2.0 * direction;
      const RayCast cast = tree.cast_ray({origin}, direction);
      EXPECT_EQ(cast.outcome, RayCast::Outcome::kHit);
      EXPECT_NEAR(cast.distance_m, 1.95, 1e-12);
    }
  }
}

TEST(RayCast, StartsInAnOccupiedVoxel) {
  const SemanticOctree tree = tree_of({{.key = {32768, 32768, 32768}, .log_odds = kOccupied}});
  const RayCast cast = tree.cast_ray({{0.05, 0.05, 0.05}}, {1.0, 0.0, 0.0});
  EXPECT_EQ(cast.outcome, RayCast::Outcome::kHit);
  EXPECT_EQ(cast.distance_m, 0.0);
}

TEST(RayCast, PassesACornerByFaces) {
  // From the voxel (0,0,0) diagonally: x first, so (1,0,0) is met and (0,1,0) is not.
  const auto met = [](const VoxelKey& key) {
    const SemanticOctree tree = tree_of({{.key = key, .log_odds = kOccupied}});
    return tree.cast_ray({{0.05, 0.05, 0.05}}, {1.0, 1.0, 0.0}).outcome == RayCast::Outcome::kHit;
  };
  EXPECT_TRUE(met({32769, 32768, 32768}));
  EXPECT_FALSE(met({32768, 32769, 32768}));
  EXPECT_TRUE(met({32769, 32769, 32768}));
}

TEST(RayCast, EndsAtTheRange) {
  const SemanticOctree tree = tree_of({{.key = {32778, 32768, 32768}, .log_odds = kOccupied}});
  const PointInMap origin{{0.05, 0.05, 0.05}};  // 0.95 m before the voxel
  EXPECT_EQ(tree.cast_ray(origin, {1.0, 0.0, 0.0}, {.max_range_m = 0.94}).outcome,
            RayCast::Outcome::kNothing);
  EXPECT_EQ(tree.cast_ray(origin, {1.0, 0.0, 0.0}, {.max_range_m = 0.96}).outcome,
            RayCast::Outcome::kHit);
}

TEST(RayCast, StopsAtTheUnknownWhenAsked) {
  const SemanticOctree tree = tree_of({{.key = {32768, 32768, 32768}, .log_odds = kFree},
                                       {.key = {32769, 32768, 32768}, .log_odds = kFree},
                                       {.key = {32771, 32768, 32768}, .log_odds = kOccupied}});
  const PointInMap origin{{0.05, 0.05, 0.05}};
  const RayCast cast = tree.cast_ray(origin, {1.0, 0.0, 0.0}, {.stop_at_unknown = true});
  EXPECT_EQ(cast.outcome, RayCast::Outcome::kUnknown);
  EXPECT_EQ(cast.key, (VoxelKey{32770, 32768, 32768}));
  EXPECT_EQ(tree.cast_ray(origin, {1.0, 0.0, 0.0}).outcome, RayCast::Outcome::kHit);
}

TEST(RayCast, WithoutAWayThereIsNothing) {
  const SemanticOctree tree = tree_of({{.key = {32768, 32768, 32768}, .log_odds = kOccupied}});
  const double nan = std::nan("");
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& direction :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(nan, 0, 0), Eigen::Vector3d(infinity, 0, 0)}) {
    EXPECT_EQ(tree.cast_ray({{0.05, 0.05, 0.05}}, direction).outcome, RayCast::Outcome::kNothing);
  }
  EXPECT_EQ(tree.cast_ray({{1e9, 0, 0}}, {1, 0, 0}).outcome, RayCast::Outcome::kNothing);
}

TEST(RayCast, EndsAtTheEdgeOfTheVolume) {
  const SemanticOctree tree = tree_of({});
  const RayCast cast = tree.cast_ray({{3276.0, 0.0, 0.0}},
                                     {1.0, 0.1, 0.0},
                                     {.max_range_m = std::numeric_limits<double>::infinity()});
  EXPECT_EQ(cast.outcome, RayCast::Outcome::kNothing);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_owners.hpp"

#include "octree/object_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <random>
#include <vector>

namespace hypermap {
namespace {

constexpr ClassId kChair{0};
constexpr ClassId kCup{1};

/// A cube of 0.4 m at the origin of its own, that much in x.
Object object_at(double x, ClassId class_id) {
  Object object;
  object.belief.observe(std::array{ClassEvidence{class_id, Probability(0.9)}}, Probability(0.5));
  object.existence = LogOdds::of(Probability(0.8));
  object.box = {{x, 0.0, 0.0}, {x + 0.4, 0.4, 0.4}};
  return object;
}

TEST(VoxelOwners, LendTheirClassAndHowSureItIs) {
  ObjectMap objects;
  const ObjectId chair = objects.add(object_at(0.0, kChair));
  const VoxelOwners owners(objects, std::array{chair});
  const auto owned = owners.find(chair, {0.2, 0.2, 0.2}, 0.05);
  ASSERT_TRUE(owned.has_value());
  EXPECT_EQ(owned->object, chair);
  EXPECT_EQ(owned->label.class_id, kChair);
  // The only class has all of the belief: 0.8 x 1.
  EXPECT_NEAR(owned->label.probability.probability().value(), 0.8, 1e-12);
}

TEST(VoxelOwners, ATentativeAGoneAndNoObjectOwnNothing) {
  ObjectMap objects;
  const ObjectId chair = objects.add(object_at(0.0, kChair));
  const ObjectId tentative = objects.add(object_at(1.0, kCup));
  const VoxelOwners owners(objects, std::array{chair, ObjectId{77}});
  EXPECT_FALSE(owners.find(tentative, {1.2, 0.2, 0.2}, 0.05));
  EXPECT_FALSE(owners.find(ObjectId{77}, {0.2, 0.2, 0.2}, 0.05));
  EXPECT_FALSE(owners.find(kNoObject, {0.2, 0.2, 0.2}, 0.05));
}

TEST(VoxelOwners, AnObjectWithoutAClassOwnsNothing) {
  ObjectMap objects;
  Object unnamed = object_at(0.0, kChair);
  unnamed.belief = {};
  const ObjectId id = objects.add(unnamed);
  EXPECT_FALSE(VoxelOwners(objects, std::array{id}).find(id, {0.2, 0.2, 0.2}, 0.05));
}

TEST(VoxelOwners, AnObjectWithoutPointsOwnsWhatIsLabelledSoInItsBoxOrNextToIt) {
  ObjectMap objects;
  const ObjectId chair = objects.add(object_at(0.0, kChair));
  const VoxelOwners owners(objects, std::array{chair});
  // The box ends at 0.4: half an edge of 0.025, and 0.0325 and 0.0025 beyond it.
  EXPECT_TRUE(owners.find(chair, {0.459, 0.2, 0.2}, 0.05));
  EXPECT_FALSE(owners.find(chair, {0.461, 0.2, 0.2}, 0.05));
  EXPECT_TRUE(owners.find(chair, {0.2, 0.2, -0.059}, 0.05));
  EXPECT_FALSE(owners.find(chair, {0.2, 0.2, -0.061}, 0.05));
  EXPECT_TRUE(owners.find(chair, {0.2, 0.2, -0.084}, 0.1)) << "a voxel twice as wide";
  EXPECT_FALSE(owners.find(chair, {0.2, 0.2, -0.086}, 0.1));
}

using Points = std::vector<Eigen::Vector3f>;

/// A plate of 2 cm spacing, 0.4 m wide from `x` and y = 0 on; its cells' middles are at z = 0.205.
Points plate_points(double x) {
  Points points;
  for (int i = 0; i <= 20; ++i) {
    for (int k = 0; k <= 20; ++k) {
      const Eigen::Vector3d p(x + 0.005 + 0.02 * i, 0.005 + 0.02 * k, 0.205);
      points.push_back(p.cast<float>());
    }
  }
  return points;
}

/// As `object_at`, seen so often: a plate, and once what is `beside` it.
Object plate_at(double x, ClassId class_id, int num_looks = 3, const Points& beside = {}) {
  Object object = object_at(x, class_id);
  Points points = plate_points(x);
  for (int i = 1; i < num_looks; ++i) object.points.observe(points);
  points.insert(points.end(), beside.begin(), beside.end());
  object.points.observe(points);
  return object;
}

TEST(VoxelOwners, AVoxelMayLieOffTheSurfaceByHalfItsEdgeAndTheNoise) {
  ObjectMap objects;
  const ObjectId table = objects.add(plate_at(0.0, kChair));
  const VoxelOwners owners(objects, std::array{table});
  const auto is_owned = [&](ObjectId label, double off_m) {
    return owners.find(label, {0.205, 0.205, 0.205 - off_m}, 0.05).has_value();
  };
  EXPECT_TRUE(is_owned(table, 0.0595));
  EXPECT_FALSE(is_owned(table, 0.0605)) << "a segment took it in";
  for (const ObjectId label : {kNoObject, ObjectId{77}}) {
    EXPECT_TRUE(is_owned(label, 0.057));
    EXPECT_FALSE(is_owned(label, 0.058));
  }
  EXPECT_EQ(owners.find(kNoObject, {0.205, 0.205, 0.205}, 0.05)->label.class_id, kChair);
}

TEST(VoxelOwners, WhatFewObservationsShowCountsBesideWhatIsSupported) {
  // One of 40 observations has a post, 8 cm and 16 cm beyond the plate's last row at 0.405 m.
  const Points post{{0.485F, 0.205F, 0.205F}, {0.565F, 0.205F, 0.205F}};
  ObjectMap objects;
  const Object object = plate_at(0.0, kChair, 40, post);
  ASSERT_EQ(std::ranges::count(object.points.standings(), CellStanding::kStray), 2);
  const ObjectId table = objects.add(object);
  const VoxelOwners owners(objects, std::array{table});
  // (0 + 0.08) / 2 is near enough, (0 + 0.16) / 2 is not.
  EXPECT_TRUE(owners.find(kNoObject, {0.485, 0.205, 0.205}, 0.05));
  EXPECT_FALSE(owners.find(kNoObject, {0.565, 0.205, 0.205}, 0.05));
  EXPECT_TRUE(owners.find(kNoObject, {0.565, 0.205, 0.205}, 0.2)) << "for a voxel of 20 cm it is";
  // Without the post 0.08 is too far.
  ObjectMap bare;
  const ObjectId plate = bare.add(plate_at(0.0, kChair, 40));
  EXPECT_FALSE(VoxelOwners(bare, std::array{plate}).find(kNoObject, {0.485, 0.205, 0.205}, 0.05));
}

TEST(VoxelOwners, OfTwoTheNearerOneOwnsTheVoxel) {
  // Rows of cells at 0.385 and 0.405 of the left one, 0.425 and 0.445 of the right one.
  ObjectMap objects;
  const ObjectId left = objects.add(plate_at(0.0, kChair));
  const ObjectId right = objects.add(plate_at(0.42, kCup));
  const VoxelOwners owners(objects, std::array{left, right});
  const auto owner_at = [&](ObjectId label, double x) {
    return owners.find(label, {x, 0.205, 0.205}, 0.05)->object;
  };
  EXPECT_EQ(owner_at(kNoObject, 0.41), left);
  EXPECT_EQ(owner_at(kNoObject, 0.42), right);
  EXPECT_EQ(owner_at(right, 0.41), left) << "5 mm against 15 mm, whatever a segment said";
  EXPECT_EQ(owner_at(left, 0.4155), left) << "10.5 mm - 2.5 mm against 9.5 mm";
  EXPECT_EQ(owner_at(kNoObject, 0.4155), right);
}

TEST(VoxelOwners, OfTwoEquallyNearTheLowerIdOwnsTheVoxel) {
  // The same plate, and a far point of either, so that their cells do not begin alike.
  ObjectMap objects;
  const Points far_of_first{{-0.305F, 0.105F, 0.105F}};
  const Points far_of_second{{-0.405F, 0.305F, 0.005F}};
  const ObjectId first = objects.add(plate_at(0.0, kChair, 3, far_of_first));
  const ObjectId second = objects.add(plate_at(0.0, kCup, 3, far_of_second));
  const VoxelOwners owners(objects, std::array{second, first});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> within(0.05, 0.35);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d middle(within(random), within(random), 0.23);
    EXPECT_EQ(owners.find(kNoObject, middle, 0.05)->object, first);
    EXPECT_EQ(owners.find(second, middle, 0.05)->object, second);
  }
}

TEST(VoxelOwners, AWallOfWideCellsOwnsAllOfItself) {
  // 3 x 3 m at 400 cells at most: they become 16 cm wide.
  Object wall = object_at(0.0, kChair);
  wall.points = OccupancyVotes({.max_cells = 400});
  Points points;
  for (float x = 0.005F; x < 3.0F; x += 0.02F) {
    for (float z = 0.005F; z < 3.0F; z += 0.02F) points.emplace_back(x, 0.205F, z);
  }
  for (int i = 0; i < 3; ++i) wall.points.observe(points);
  ASSERT_NEAR(wall.points.state().edge_m, 0.16, 1e-12);
  wall.box = *wall.points.agreed_box();
  ObjectMap objects;
  const ObjectId id = objects.add(wall);
  const VoxelOwners owners(objects, std::array{id});
  for (double x = 0.025; x < 3.0; x += 0.05) {
    for (double z = 0.025; z < 3.0; z += 0.05) {
      EXPECT_TRUE(owners.find(kNoObject, {x, 0.225, z}, 0.05)) << x << ' ' << z;
    }
  }
  EXPECT_FALSE(owners.find(id, {1.5, 0.525, 1.5}, 0.05));
}

constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// By its definition.
double distance_by_force(const OccupancyVotes& points, const Eigen::Vector3d& place) {
  double to_any = kNowhere;
  double to_supported = to_any;
  for (std::size_t i = 0; i < points.state().votes.size(); ++i) {
    const PointCell& cell = points.state().votes[i].cell;
    const Eigen::Vector3d middle =
        points.state().edge_m * Eigen::Vector3d(cell.x + 0.5, cell.y + 0.5, cell.z + 0.5);
    const double distance = (middle - place).norm();
    to_any = std::min(to_any, distance);
    if (points.standings()[i] != CellStanding::kStray)
      to_supported = std::min(to_supported, distance);
  }
  return 0.5 * (to_any + to_supported);
}

TEST(ObjectSurface, IsAsFarAsItsCellsAreOneByOne) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-0.3, 0.3);
  // A hundred kilometres from the origin floats alone would be a centimetre off.
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e5, -1e5, 50.0)}) {
    const auto place = [&] {
      return Eigen::Vector3d(at + Eigen::Vector3d(within(random), within(random), within(random)));
    };
    OccupancyVotes points;
    Points steady;
    for (int i = 0; i < 40; ++i) steady.push_back(place().cast<float>());
    for (int look = 0; look < 30; ++look) {
      Points seen = steady;
      if (look % 5 == 0) seen.push_back(place().cast<float>());
      points.observe(seen);
    }
    ASSERT_GT(std::ranges::count(points.standings(), CellStanding::kStray), 0);
    const ObjectSurface surface(points);
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d from = place();
      const double by_force = distance_by_force(points, from);
      EXPECT_NEAR(surface.distance_m(from, by_force + 1e-6), by_force, 1e-6);
      EXPECT_EQ(surface.distance_m(from, by_force - 1e-6), kNowhere);
    }
  }
}

TEST(ObjectSurface, WithoutCellsIsNowhere) {
  const ObjectSurface none{OccupancyVotes()};
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.distance_m({0, 0, 0}, kNowhere), kNowhere);
}

TEST(OwnedLeaves, BearTheOwnersClassWhateverTheirOwnBeliefSays) {
  ObjectMap objects;
  const ObjectId chair = objects.add(object_at(0.0, kChair));
  SemanticOctree octree = SemanticOctree::create({}).value();
  VoxelLabel label;
  label.classes[0] = {static_cast<std::uint16_t>(kCup.value), 9000};
  label.object = chair;
  label.object_votes = 3;
  const auto put = [&](double x, const VoxelLabel& at) {
    const VoxelKey key = octree.grid().key(PointInMap{{x, 0.22, 0.22}}).value();
    ASSERT_TRUE(octree.set_leaf({.key = key, .log_odds = 1000, .label = at}));
  };
  put(0.22, label);
  label.object = kNoObject;
  label.object_votes = 0;
  put(0.32, label);
  std::vector<LeafSample> leaves;
  owned_leaves(octree, VoxelOwners(objects, std::array{chair}))(
      [&](const LeafSample& leaf) { leaves.push_back(leaf); });
  ASSERT_EQ(leaves.size(), 2U);
  EXPECT_EQ(leaves[0].best_class, kChair);
  EXPECT_EQ(leaves[0].object, chair);
  EXPECT_NEAR(leaves[0].class_log_odds.probability().value(), 0.8, 1e-12);
  EXPECT_EQ(leaves[1].best_class, std::nullopt) << "a cup that no object holds";
  EXPECT_EQ(leaves[1].class_log_odds, LogOdds());
  EXPECT_TRUE(leaves[1].occupied);
}

}  // namespace
}  // namespace hypermap

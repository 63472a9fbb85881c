// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_owners.hpp"

#include "octree/point_mask.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

TEST(VoxelOwners, AVoxelMayStickOutByTheNoiseOfASurfaceAndHalfItsEdge) {
  ObjectMap objects;
  const ObjectId chair = objects.add(object_at(0.0, kChair));
  const VoxelOwners owners(objects, std::array{chair});
  // The box ends at 0.4: 0.4 + 0.05 + 0.025 = 0.475.
  EXPECT_TRUE(owners.find(chair, {0.474, 0.2, 0.2}, 0.05));
  EXPECT_FALSE(owners.find(chair, {0.476, 0.2, 0.2}, 0.05));
  EXPECT_TRUE(owners.find(chair, {0.2, 0.2, -0.074}, 0.05));
  EXPECT_FALSE(owners.find(chair, {0.2, 0.2, -0.076}, 0.05));
}

/// As `object_at`, seen three times: a plate of 2 cm spacing at z = 0.2.
Object plate_at(double x, ClassId class_id) {
  Object object = object_at(x, class_id);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 20; ++i) {
    for (int k = 0; k <= 20; ++k) {
      const Eigen::Vector3d p(x + 0.02 * i, 0.02 * k, 0.2);
      points.push_back(p.cast<float>());
    }
  }
  for (int i = 0; i < 3; ++i) object.points.observe(points);
  return object;
}

TEST(VoxelOwners, WhatIsLabelledFarFromTheObjectsPointsIsNotItsOwn) {
  // Inside the box, but 0.125 m below the plate: a segment took it in once.
  ObjectMap objects;
  const ObjectId table = objects.add(plate_at(0.0, kChair));
  const VoxelOwners owners(objects, std::array{table});
  EXPECT_TRUE(owners.find(table, {0.225, 0.225, 0.175}, 0.05));
  EXPECT_TRUE(owners.find(table, {0.225, 0.225, 0.135}, 0.05)) << "within the noise of 5 cm";
  EXPECT_FALSE(owners.find(table, {0.225, 0.225, 0.075}, 0.05));
}

TEST(VoxelOwners, WhatNoSegmentNamedIsOwnedWhereThePointsLie) {
  ObjectMap objects;
  Object plate = plate_at(0.0, kChair);
  plate.box = *plate.points.agreed_box();
  const ObjectId table = objects.add(plate);
  const ObjectId tentative = objects.add(object_at(0.0, kCup));
  const VoxelOwners owners(objects, std::array{table});
  for (const ObjectId label : {kNoObject, tentative, ObjectId{77}}) {
    const auto owned = owners.find(label, {0.225, 0.225, 0.205}, 0.05);
    ASSERT_TRUE(owned.has_value());
    EXPECT_EQ(owned->object, table);
    EXPECT_EQ(owned->label.class_id, kChair);
    // The plate is 3 cm beyond the cube's upper face: near enough for its own label alone.
    EXPECT_FALSE(owners.find(label, {0.225, 0.225, 0.145}, 0.05));
  }
}

TEST(VoxelOwners, WhatLiesAmongItsPointsIsOwnedWhenNobodyElseIsThere) {
  // The plate lies at 0.2 m in a box from 0 to 0.4 m; a cube at 0.145 m ends 3 cm below it.
  const auto owner_at = [](const Object& plate, const Eigen::Vector3d& middle) {
    ObjectMap objects;
    const std::array ids{objects.add(plate)};
    return VoxelOwners(objects, ids).find(kNoObject, middle, 0.05);
  };
  Object plate = plate_at(0.0, kChair);
  EXPECT_TRUE(owner_at(plate, {0.225, 0.225, 0.145}));
  EXPECT_FALSE(owner_at(plate, {0.42, 0.225, 0.145})) << "outside the hull";
  EXPECT_FALSE(owner_at(plate, {0.225, 0.225, 0.11})) << "over 5 cm from a point";
  plate.box.min_in_map.z() = 0.1;
  EXPECT_FALSE(owner_at(plate, {0.225, 0.225, 0.145})) << "not a voxel above the lowest face";
  plate.box.min_in_map.z() = 0.09;
  EXPECT_TRUE(owner_at(plate, {0.225, 0.225, 0.145}));
}

TEST(VoxelOwners, WhatLiesAmongThePointsOfTwoIsNobodys) {
  ObjectMap objects;
  const std::array both{objects.add(plate_at(0.0, kChair)), objects.add(plate_at(0.01, kCup))};
  EXPECT_FALSE(VoxelOwners(objects, both).find(kNoObject, {0.225, 0.225, 0.145}, 0.05));
}

TEST(VoxelOwners, OfTwoTheOneWithMorePointsOwnsTheVoxel) {
  ObjectMap objects;
  const ObjectId left = objects.add(plate_at(0.0, kChair));
  const ObjectId right = objects.add(plate_at(0.41, kCup));
  const VoxelOwners owners(objects, std::array{left, right});
  EXPECT_EQ(owners.find(kNoObject, {0.39, 0.225, 0.2}, 0.05)->object, left);
  EXPECT_EQ(owners.find(kNoObject, {0.42, 0.225, 0.2}, 0.05)->object, right);
  EXPECT_EQ(owners.find(right, {0.39, 0.225, 0.2}, 0.05)->object, right) << "it is labelled so";
}

TEST(PointMask, CountsTheCellsThatABoxTouches) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-0.3, 0.3);
  std::vector<Eigen::Vector3d> points;
  points.reserve(60);
  for (int i = 0; i < 60; ++i) points.emplace_back(within(random), within(random), within(random));
  const PointMask mask(points, 0.1);
  Eigen::Vector3d low = points.front();
  for (const Eigen::Vector3d& p : points) low = low.cwiseMin(p);
  for (int round = 0; round < 200; ++round) {
    const Eigen::Vector3d a(within(random), within(random), within(random));
    const Eigen::Vector3d b(within(random), within(random), within(random));
    const Box box{1.5 * a.cwiseMin(b), 1.5 * a.cwiseMax(b)};
    std::vector<std::array<int, 3>> touched;
    for (const Eigen::Vector3d& p : points) {
      const Eigen::Array3d corner = ((p - low).array() / 0.1).floor();
      const Box cell{low + 0.1 * corner.matrix(), low + 0.1 * (corner + 1.0).matrix()};
      if (!cell.intersects(box)) continue;
      touched.push_back({static_cast<int>(corner.x()),
                         static_cast<int>(corner.y()),
                         static_cast<int>(corner.z())});
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    EXPECT_EQ(mask.count(box), touched.size());
  }
}

TEST(PointMask, PointsFarApartHaveWiderCells) {
  const std::vector<Eigen::Vector3d> points{{-1e6, 0, 0}, {1e6, 1e6, 0.5}};
  const PointMask mask(points, 0.01);
  EXPECT_EQ(mask.count({{-1e7, -1e7, -1e7}, {1e7, 1e7, 1e7}}), 2U);
  EXPECT_EQ(mask.count({{1e7, 1e7, 1e7}, {1e300, 1e300, 1e300}}), 0U);
  EXPECT_TRUE(PointMask({}, 0.01).empty());
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

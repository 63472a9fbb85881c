// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_owners.hpp"

#include <gtest/gtest.h>

#include <array>
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
  const OwnerLabel* label = owners.find(chair, {0.2, 0.2, 0.2}, 0.05);
  ASSERT_NE(label, nullptr);
  EXPECT_EQ(label->class_id, kChair);
  // The only class has all of the belief: 0.8 x 1.
  EXPECT_NEAR(label->probability.probability().value(), 0.8, 1e-12);
}

TEST(VoxelOwners, ATentativeAGoneAndNoObjectOwnNothing) {
  ObjectMap objects;
  const ObjectId chair = objects.add(object_at(0.0, kChair));
  const ObjectId tentative = objects.add(object_at(1.0, kCup));
  const VoxelOwners owners(objects, std::array{chair, ObjectId{77}});
  EXPECT_EQ(owners.find(tentative, {1.2, 0.2, 0.2}, 0.05), nullptr);
  EXPECT_EQ(owners.find(ObjectId{77}, {0.2, 0.2, 0.2}, 0.05), nullptr);
  EXPECT_EQ(owners.find(kNoObject, {0.2, 0.2, 0.2}, 0.05), nullptr);
}

TEST(VoxelOwners, AnObjectWithoutAClassOwnsNothing) {
  ObjectMap objects;
  Object unnamed = object_at(0.0, kChair);
  unnamed.belief = {};
  const ObjectId id = objects.add(unnamed);
  EXPECT_EQ(VoxelOwners(objects, std::array{id}).find(id, {0.2, 0.2, 0.2}, 0.05), nullptr);
}

TEST(VoxelOwners, AVoxelMayStickOutByTheNoiseOfASurfaceAndHalfItsEdge) {
  ObjectMap objects;
  const ObjectId chair = objects.add(object_at(0.0, kChair));
  const VoxelOwners owners(objects, std::array{chair});
  // The box ends at 0.4: 0.4 + 0.05 + 0.025 = 0.475.
  EXPECT_NE(owners.find(chair, {0.474, 0.2, 0.2}, 0.05), nullptr);
  EXPECT_EQ(owners.find(chair, {0.476, 0.2, 0.2}, 0.05), nullptr);
  EXPECT_NE(owners.find(chair, {0.2, 0.2, -0.074}, 0.05), nullptr);
  EXPECT_EQ(owners.find(chair, {0.2, 0.2, -0.076}, 0.05), nullptr);
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

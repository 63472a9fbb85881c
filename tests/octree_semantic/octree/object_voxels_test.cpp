// SPDX-License-Identifier: BSD-3-Clause
// Voxels of objects: relabelled, divided, forgotten.
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"
#include "octree_semantic/support/random_octree.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

using test::empty_tree;
using test::label_of;
using test::random_leaves;
using test::stored;

TEST(ObjectVoxels, RelabellingChangesAnObjectsVoxelsAndNothingElse) {
  const std::vector<StoredLeaf> leaves = random_leaves(2000);
  SemanticOctree tree = SemanticOctree::from_leaves({}, leaves).value();
  std::vector<StoredLeaf> expected = leaves;
  std::size_t num_expected = 0;
  for (StoredLeaf& leaf : expected) {
    if (!leaf.label || leaf.label->object != ObjectId{1}) continue;
    leaf.label->object = ObjectId{3};
    ++num_expected;
  }
  EXPECT_EQ(tree.relabel_object(ObjectId{1}, ObjectId{3}), num_expected);
  EXPECT_EQ(stored(tree), expected);
  EXPECT_EQ(tree.relabel_object(ObjectId{1}, ObjectId{3}), 0U);
  EXPECT_EQ(tree.relabel_object(kNoObject, ObjectId{3}), 0U);
}

TEST(ObjectVoxels, ErasedObjectsLeaveValidLabelsBehind) {
  SemanticOctree tree = SemanticOctree::from_leaves({}, random_leaves(500)).value();
  EXPECT_GT(tree.relabel_object(ObjectId{2}, kNoObject), 0U);
  for (const StoredLeaf& leaf : stored(tree)) {
    if (!leaf.label) continue;
    EXPECT_NE(leaf.label->object, ObjectId{2});
    EXPECT_TRUE(validate(*leaf.label, 10000));
  }
}

TEST(ObjectVoxels, ObjectsAreForgottenInOnePass) {
  SemanticOctree one_by_one = SemanticOctree::from_leaves({}, random_leaves(2000)).value();
  SemanticOctree at_once = one_by_one;
  const std::size_t num_voxels = one_by_one.relabel_object(ObjectId{1}, kNoObject) +
                                 one_by_one.relabel_object(ObjectId{2}, kNoObject);
  EXPECT_GT(num_voxels, 0U);
  EXPECT_EQ(at_once.forget_objects([](ObjectId id) { return id.value <= 2; }), num_voxels);
  EXPECT_TRUE(at_once == one_by_one);
}

TEST(ObjectVoxels, RelabellingStaysWithinItsBox) {
  SemanticOctree tree = empty_tree(0.1);
  const StoredLeaf near{.key = {32768, 32768, 32768}, .log_odds = 500, .label = label_of(1, 4)};
  const StoredLeaf far{.key = {32800, 32768, 32768}, .log_odds = 500, .label = label_of(1, 4)};
  ASSERT_TRUE(tree.set_leaf(near));
  ASSERT_TRUE(tree.set_leaf(far));
  const Box box{Eigen::Vector3d::Constant(-0.5), Eigen::Vector3d::Constant(0.5)};
  EXPECT_EQ(tree.relabel_object(ObjectId{4}, ObjectId{5}, box), 1U);
  EXPECT_EQ(tree.at(near.key)->object, ObjectId{5});
  EXPECT_EQ(tree.at(far.key)->object, ObjectId{4});
}

TEST(ObjectVoxels, AnObjectsVoxelsAreDividedByPointSets) {
  // Voxels of object 4 at x = 0.05, 0.15, ... 0.95 m; those of the points at the ends are nearer.
  SemanticOctree tree = empty_tree(0.1);
  for (std::uint16_t i = 0; i < 10; ++i) {
    const VoxelKey key{static_cast<std::uint16_t>(32768 + i), 32768, 32768};
    ASSERT_TRUE(tree.set_leaf({.key = key, .log_odds = 500, .label = label_of(1, i < 9 ? 4 : 3)}));
  }
  const std::vector<Eigen::Vector3f> left{{0.05F, 0.05F, 0.05F}, {0.35F, 0.05F, 0.05F}};
  const std::vector<Eigen::Vector3f> right{{0.85F, 0.05F, 0.05F}};
  // The middle between 0.35 and 0.85 is 0.6: voxels from 0.65 on go; the last is of object 3.
  EXPECT_EQ(tree.divide_object(ObjectId{4}, ObjectId{9}, left, right), 3U);
  for (std::uint16_t i = 0; i < 10; ++i) {
    const auto label = tree.stored_at({static_cast<std::uint16_t>(32768 + i), 32768, 32768})->label;
    EXPECT_EQ(label->object, i == 9 ? ObjectId{3} : (i < 6 ? ObjectId{4} : ObjectId{9})) << i;
    EXPECT_GT(label->object_votes, 0U) << "votes go along";
  }
  EXPECT_EQ(tree.divide_object(ObjectId{4}, ObjectId{9}, left, {}), 0U);
  EXPECT_EQ(tree.divide_object(ObjectId{4}, ObjectId{9}, {}, right), 6U);
}

TEST(ObjectVoxels, VoxelsOfAnObjectMoveByWhateverTheCallerSays) {
  SemanticOctree tree = SemanticOctree::from_leaves({}, random_leaves(500)).value();
  const std::vector<StoredLeaf> before = stored(tree);
  const auto even = [](const VoxelKey& key) { return key.x % 2 == 0; };
  const Box all{Eigen::Vector3d::Constant(-1e4), Eigen::Vector3d::Constant(1e4)};
  const std::size_t num_moved = tree.divide_object(ObjectId{1}, ObjectId{8}, all, even);
  std::size_t num_expected = 0;
  std::vector<StoredLeaf> expected = before;
  for (StoredLeaf& leaf : expected) {
    if (!leaf.label || leaf.label->object != ObjectId{1} || !even(leaf.key)) continue;
    leaf.label->object = ObjectId{8};
    ++num_expected;
  }
  EXPECT_GT(num_moved, 0U);
  EXPECT_EQ(num_moved, num_expected);
  EXPECT_EQ(stored(tree), expected);
}

}  // namespace
}  // namespace hypermap

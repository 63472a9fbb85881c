// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/semantic_octree.hpp"

#include "octree_semantic/support/random_octree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

namespace hypermap {
namespace {

using test::empty_tree;
using test::label_of;
using test::random_leaves;
using test::stored;

TEST(SemanticOctree, RefusesImpossibleOptions) {
  for (const double resolution_m : {0.0, -0.05, 1e-4, 11.0, std::nan("")}) {
    const auto made = SemanticOctree::create({.resolution_m = resolution_m});
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().field, "resolution_m");
  }
  EXPECT_FALSE(SemanticOctree::create({.max_class_log_odds = LogOdds(40.0)}));
}

TEST(SemanticOctree, KnowsNothingAtFirst) {
  const SemanticOctree tree = empty_tree();
  EXPECT_TRUE(tree.empty());
  EXPECT_FALSE(tree.at(PointInMap{{0.0, 0.0, 0.0}}));
  EXPECT_FALSE(tree.at(PointInMap{{1e9, 0.0, std::nan("")}}));
  EXPECT_TRUE(stored(tree).empty());
}

TEST(SemanticOctree, TellsWhatIsAtAPoint) {
  SemanticOctree tree = empty_tree(0.1);
  const VoxelKey key{32769, 32768, 32767};
  ASSERT_TRUE(tree.set_leaf({.key = key, .log_odds = 847, .label = label_of(5, 9)}));
  const auto leaf = tree.at(PointInMap{{0.19, 0.01, -0.01}});
  ASSERT_TRUE(leaf);
  EXPECT_TRUE(leaf->centre_in_map.isApprox(Eigen::Vector3d(0.15, 0.05, -0.05), 1e-12));
  EXPECT_DOUBLE_EQ(leaf->edge_m, 0.1);
  EXPECT_DOUBLE_EQ(leaf->occupancy.value(), 0.847);
  EXPECT_TRUE(leaf->occupied);
  EXPECT_EQ(leaf->best_class, ClassId{5});
  EXPECT_EQ(leaf->object, ObjectId{9});
  EXPECT_FALSE(tree.at(PointInMap{{0.21, 0.01, -0.01}}));
}

TEST(SemanticOctree, IsOccupiedFromTheThresholdOn) {
  SemanticOctree tree = empty_tree();
  const VoxelKey key{1, 2, 3};
  for (const auto& [log_odds, occupied] : {std::pair{-1, false}, {0, true}, {1, true}}) {
    ASSERT_TRUE(tree.set_leaf({.key = key, .log_odds = static_cast<MilliLogOdds>(log_odds)}));
    EXPECT_EQ(tree.at(key)->occupied, occupied) << log_odds;
  }
}

TEST(SemanticOctree, EmptySpaceHasNoClassButRemembersIt) {
  SemanticOctree tree = empty_tree();
  const StoredLeaf leaf{.key = {9, 9, 9}, .log_odds = -300, .label = label_of(1, 2)};
  ASSERT_TRUE(tree.set_leaf(leaf));
  EXPECT_EQ(tree.at(leaf.key)->best_class, std::nullopt);
  EXPECT_EQ(tree.at(leaf.key)->object, kNoObject);
  EXPECT_EQ(tree.stored_at(leaf.key), leaf);
}

TEST(SemanticOctree, LeavesComeBackInMortonOrderWhateverTheOrderTheyWereSetIn) {
  const std::vector<StoredLeaf> leaves = random_leaves(3000);
  std::vector<StoredLeaf> shuffled = leaves;
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
  const auto tree = SemanticOctree::from_leaves({.resolution_m = 0.1}, leaves).value();
  const auto other = SemanticOctree::from_leaves({.resolution_m = 0.1}, shuffled).value();
  EXPECT_EQ(stored(tree), leaves);
  EXPECT_EQ(stored(other), leaves);
  EXPECT_EQ(tree, other);
  const auto occupied = std::count_if(
      leaves.begin(), leaves.end(), [](const StoredLeaf& leaf) { return leaf.log_odds >= 0; });
  EXPECT_EQ(tree.num_leaves(),
            (LeafCount{static_cast<std::size_t>(occupied),
                       leaves.size() - static_cast<std::size_t>(occupied)}));
}

TEST(SemanticOctree, RefusesLeavesThatCannotBe) {
  const StoredLeaf good{.key = {1, 1, 1}, .log_odds = 100};
  StoredLeaf beyond_clamp = good;
  beyond_clamp.log_odds = 3512;
  StoredLeaf bad_label = good;
  bad_label.label = VoxelLabel{};
  bad_label.label->rest = 20000;
  EXPECT_EQ(SemanticOctree::from_leaves({}, std::vector{good, good}).error().field, "key");
  EXPECT_EQ(SemanticOctree::from_leaves({}, std::vector{beyond_clamp}).error().field, "log_odds");
  EXPECT_EQ(SemanticOctree::from_leaves({}, std::vector{bad_label}).error().field, "rest");
}

TEST(SemanticOctree, ManyLeavesAreSetAsOneByOneOrNotAtAll) {
  const std::vector<StoredLeaf> leaves = random_leaves(3000);
  SemanticOctree one_by_one = empty_tree();
  for (const StoredLeaf& leaf : leaves) ASSERT_TRUE(one_by_one.set_leaf(leaf));
  SemanticOctree at_once = empty_tree();
  ASSERT_TRUE(at_once.set_leaves(leaves));
  EXPECT_EQ(at_once, one_by_one);
  EXPECT_EQ(at_once.revision(), 1U);
  ASSERT_TRUE(at_once.set_leaves({}));
  EXPECT_EQ(at_once.revision(), 1U);
  std::vector<StoredLeaf> refused{leaves[1], {.key = {1, 1, 1}, .log_odds = 3512}};
  refused.front().log_odds = static_cast<MilliLogOdds>(leaves[1].log_odds - 1);
  EXPECT_EQ(at_once.set_leaves(refused).error().field, "log_odds");
  EXPECT_EQ(at_once, one_by_one);
}

TEST(SemanticOctree, ACopyStaysAsItWasWhileTheOriginalChanges) {
  SemanticOctree tree = SemanticOctree::from_leaves({}, random_leaves(500)).value();
  const SemanticOctree snapshot = tree;
  const std::vector<StoredLeaf> before = stored(snapshot);
  EXPECT_EQ(tree, snapshot);
  ASSERT_TRUE(tree.set_leaf({.key = before.front().key, .log_odds = 3511}));
  EXPECT_GT(tree.relabel_object(ObjectId{1}, ObjectId{7}), 0U);
  EXPECT_EQ(stored(snapshot), before);
  EXPECT_FALSE(tree == snapshot);
}

TEST(SemanticOctree, QueriesAgreeWithALookAtEveryLeaf) {
  const SemanticOctree tree =
      SemanticOctree::from_leaves({.resolution_m = 0.1}, random_leaves(4000)).value();
  std::vector<LeafSample> all;
  tree.for_each_leaf([&](const LeafSample& leaf) { all.push_back(leaf); });
  const auto expect_same = [&](const auto& query, const auto& wanted) {
    std::vector<Eigen::Vector3d> found;
    query([&](const LeafSample& leaf) { found.push_back(leaf.centre_in_map); });
    std::vector<Eigen::Vector3d> expected;
    for (const LeafSample& leaf : all) {
      if (wanted(leaf)) expected.push_back(leaf.centre_in_map);
    }
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(found, expected);
  };
  for (const double half : {0.3, 0.75, 5.0}) {
    const Box box{Eigen::Vector3d::Constant(-half), Eigen::Vector3d(half, half / 2, half)};
    expect_same([&](const auto& visit) { tree.for_each_leaf_in(box, visit); },
                [&](const LeafSample& leaf) { return box.contains(leaf.centre_in_map); });
    expect_same([&](const auto& visit) { tree.for_each_leaf_of(ObjectId{2}, box, visit); },
                [&](const LeafSample& leaf) {
                  return leaf.object == ObjectId{2} && box.contains(leaf.centre_in_map);
                });
  }
  expect_same([&](const auto& visit) { tree.for_each_leaf_of(ClassId{3}, visit); },
              [](const LeafSample& leaf) { return leaf.best_class == ClassId{3}; });
  expect_same([&](const auto& visit) { tree.for_each_leaf_of(ObjectId{2}, visit); },
              [](const LeafSample& leaf) { return leaf.object == ObjectId{2}; });
}

TEST(SemanticOctree, LabelsAreThoseOfTheStoredLeaves) {
  const SemanticOctree tree = SemanticOctree::from_leaves({}, random_leaves(4000)).value();
  std::map<ObjectId, int> expected;
  for (const StoredLeaf& leaf : stored(tree))
    if (leaf.label) ++expected[leaf.label->object];
  ASSERT_GT(expected.size(), 1U);
  std::map<ObjectId, int> found;
  tree.for_each_label([&](const VoxelLabel& label) { ++found[label.object]; });
  EXPECT_EQ(found, expected);
}

TEST(SemanticOctree, ABoxOfNothingFindsNothing) {
  const SemanticOctree tree = SemanticOctree::from_leaves({}, random_leaves(100)).value();
  const double nan = std::nan("");
  for (const Box& box : {Box{Eigen::Vector3d::Constant(1.0), Eigen::Vector3d::Constant(-1.0)},
                         Box{Eigen::Vector3d::Constant(nan), Eigen::Vector3d::Constant(nan)},
                         Box{Eigen::Vector3d::Constant(1e12), Eigen::Vector3d::Constant(1e13)}}) {
    tree.for_each_leaf_in(box, [](const LeafSample&) { FAIL(); });
  }
}

TEST(SemanticOctree, MemoryIsCounted) {
  SemanticOctree tree = empty_tree();
  const std::size_t before = tree.memory_bytes();
  ASSERT_TRUE(tree.set_leaf({.key = {1, 2, 3}, .log_odds = 5, .label = label_of(1, 1)}));
  EXPECT_GE(tree.memory_bytes(), before + kBrickVolume * sizeof(MilliLogOdds) + sizeof(VoxelLabel));
}

TEST(SemanticOctree, TellsWhichRegionsChanged) {
  SemanticOctree tree = empty_tree(0.1);
  EXPECT_EQ(tree.revision(), 0U);
  ASSERT_TRUE(tree.set_leaf({.key = {32768, 32768, 32768}, .log_odds = 500}));
  ASSERT_TRUE(tree.set_leaf({.key = {32784, 32768, 32767}, .log_odds = 500}));
  const Revision first = tree.revision();
  ASSERT_TRUE(tree.set_leaf({.key = {32769, 32770, 32768}, .log_odds = -400}));
  // Bricks are cubes of 0.8 m: 16 voxels of 0.1 m along x lie in the third, -1 along z below.
  const auto is_box = [](const Box& box, const Eigen::Vector3d& min) {
    return (box.min_in_map - min).norm() < 1e-9 &&
           (box.max_in_map - min - Eigen::Vector3d::Constant(0.8)).norm() < 1e-9;
  };
  const std::vector<Box> all = tree.changed_regions(0);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(is_box(all[0], {1.6, 0.0, -0.8})) << "Morton order: the upper half of z is later";
  EXPECT_TRUE(is_box(all[1], {0.0, 0.0, 0.0}));
  const std::vector<Box> later = tree.changed_regions(first);
  ASSERT_EQ(later.size(), 1U);
  EXPECT_TRUE(is_box(later[0], {0.0, 0.0, 0.0}));
  EXPECT_TRUE(tree.changed_regions(tree.revision()).empty());
}

TEST(SemanticOctree, ACopyStaysWhatItWas) {
  SemanticOctree tree = SemanticOctree::from_leaves({}, random_leaves(2000)).value();
  const SemanticOctree copy = tree;
  const std::vector<StoredLeaf> before = stored(tree);
  EXPECT_GT(tree.relabel_object(ObjectId{1}, ObjectId{3}), 0U);
  ASSERT_TRUE(tree.set_leaf({.key = {1, 2, 3}, .log_odds = 5}));
  EXPECT_EQ(stored(copy), before);
  EXPECT_FALSE(copy == tree);
  EXPECT_EQ(copy.revision() + 2, tree.revision());
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/merged_octree.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

namespace hypermap {
namespace {

VoxelKey voxel_at(int x, int y = 0, int z = 0) {
  return {static_cast<std::uint16_t>(kOriginKey + x),
          static_cast<std::uint16_t>(kOriginKey + y),
          static_cast<std::uint16_t>(kOriginKey + z)};
}

SemanticOctree octree_of(const std::vector<StoredLeaf>& leaves) {
  return SemanticOctree::from_leaves({}, leaves).value();
}

MilliLogOdds log_odds_at(const SemanticOctree& octree, const VoxelKey& key) {
  return octree.stored_at(key).value().log_odds;
}

/// Some voxels of a cube of 24 voxels a side, so that bricks are shared, of one map or of both.
SemanticOctree random_octree(std::uint64_t seed, int most) {
  CounterRng random(seed, 0);
  std::map<std::tuple<int, int, int>, StoredLeaf> leaves;
  for (int i = 0; i < 600; ++i) {
    const int x = static_cast<int>(random.below(24));
    const int y = static_cast<int>(random.below(24));
    const int z = static_cast<int>(random.below(24));
    const int log_odds =
        static_cast<int>(random.below(2U * static_cast<std::uint32_t>(most))) - most;
    StoredLeaf leaf{.key = voxel_at(x, y, z), .log_odds = static_cast<MilliLogOdds>(log_odds)};
    if (i % 3 == 0) {
      leaf.label = VoxelLabel{};
      leaf.label->classes[0] = {static_cast<std::uint16_t>(random.below(3)), 400};
      leaf.label->object = ObjectId{1 + static_cast<std::uint32_t>(random.below(4))};
      leaf.label->object_votes = 1;
    }
    leaves[{x, y, z}] = leaf;
  }
  std::vector<StoredLeaf> all;
  all.reserve(leaves.size());
  for (const auto& [place, leaf] : leaves) all.push_back(leaf);
  return octree_of(all);
}

std::map<std::tuple<int, int, int>, int> log_odds_of_all(const SemanticOctree& octree) {
  std::map<std::tuple<int, int, int>, int> all;
  octree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    all[{leaf.key.x, leaf.key.y, leaf.key.z}] = leaf.log_odds;
  });
  return all;
}

TEST(MergedOctree, LogOddsAddUpAndStopAtTheClamps) {
  const auto a =
      octree_of({{voxel_at(0), 847}, {voxel_at(1), 3000}, {voxel_at(2), -1900}, {voxel_at(3), 5}});
  const auto b =
      octree_of({{voxel_at(0), -405}, {voxel_at(1), 847}, {voxel_at(2), -405}, {voxel_at(9), -7}});
  const SemanticOctree sum = merged(a, b).value();
  EXPECT_EQ(log_odds_at(sum, voxel_at(0)), 442);
  EXPECT_EQ(log_odds_at(sum, voxel_at(1)), 3511);
  EXPECT_EQ(log_odds_at(sum, voxel_at(2)), -2000);
  EXPECT_EQ(log_odds_at(sum, voxel_at(3)), 5);
  EXPECT_EQ(log_odds_at(sum, voxel_at(9)), -7);
  EXPECT_EQ(sum.num_leaves(), (LeafCount{.occupied = 3, .free = 2}));
  EXPECT_EQ(a.num_leaves().free, 1U) << "the map that was added to stays as it is";
}

TEST(MergedOctree, IsTheSumOfAllVoxelsByBruteForce) {
  const SemanticOctree a = random_octree(1, 1900);
  const SemanticOctree b = random_octree(2, 1900);
  auto expected = log_odds_of_all(a);
  for (const auto& [place, log_odds] : log_odds_of_all(b)) {
    const int sum = expected.contains(place) ? expected.at(place) + log_odds : log_odds;
    expected[place] = std::clamp(sum, -2000, 3511);
  }
  EXPECT_EQ(log_odds_of_all(merged(a, b).value()), expected);
}

TEST(MergedOctree, OfVoxelsThatNoClampStoppedTheOrderDoesNotMatter) {
  const std::array maps{random_octree(1, 600), random_octree(2, 600), random_octree(3, 600)};
  std::array order{0U, 1U, 2U};
  const auto first = merged(merged(maps[0], maps[1]).value(), maps[2]).value();
  do {
    const auto left =
        merged(merged(maps[order[0]], maps[order[1]]).value(), maps[order[2]]).value();
    const auto right =
        merged(maps[order[0]], merged(maps[order[1]], maps[order[2]]).value()).value();
    EXPECT_EQ(log_odds_of_all(left), log_odds_of_all(first));
    EXPECT_EQ(log_odds_of_all(right), log_odds_of_all(first));
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(MergedOctree, OfTwoMapsTheOrderDoesNotMatterToTheLabels) {
  const SemanticOctree a = random_octree(4, 1500);
  const SemanticOctree b = random_octree(5, 1500);
  EXPECT_TRUE(merged(a, b).value() == merged(b, a).value());
}

TEST(MergedOctree, AnEmptyMapChangesNothing) {
  const SemanticOctree a = random_octree(6, 1900);
  EXPECT_TRUE(merged(a, octree_of({})).value() == a);
  EXPECT_TRUE(merged(octree_of({}), a).value() == a);
}

TEST(MergedOctree, ALaterMapReplacesWhereItsEvidenceWasOnceClamped) {
  // -1153 = -2000 + 847: a hit after enough misses; -1215 = -3 * 405 never came to the clamp.
  const auto before = octree_of(
      {{voxel_at(0), 3511}, {voxel_at(1), -2000}, {voxel_at(2), 3511}, {voxel_at(3), 3511}});
  const auto after = octree_of(
      {{voxel_at(0), -2000}, {voxel_at(1), 3511}, {voxel_at(2), -1215}, {voxel_at(3), -1153}});
  const SemanticOctree later = merged(before, after, {.times = MergedTimes::kLater}).value();
  EXPECT_EQ(log_odds_at(later, voxel_at(0)), -2000);
  EXPECT_EQ(log_odds_at(later, voxel_at(1)), 3511);
  EXPECT_EQ(log_odds_at(later, voxel_at(2)), 2296);
  EXPECT_EQ(log_odds_at(later, voxel_at(3)), -1153);
  const SemanticOctree beside = merged(before, after).value();
  EXPECT_EQ(log_odds_at(beside, voxel_at(3)), 2358);
}

/// Log-odds after these hits (true) and misses, from what was known before.
MilliLogOdds after_updates(int log_odds, const std::vector<bool>& updates) {
  for (const bool is_hit : updates) {
    log_odds = std::clamp(log_odds + (is_hit ? 847 : -405), -2000, 3511);
  }
  return static_cast<MilliLogOdds>(log_odds);
}

TEST(MergedOctree, ALaterMapBringsVoxelsToWhereOneMapOfAllFramesHasThem) {
  CounterRng random(7, 0);
  const auto draw = [&random] {
    const double hit_share = random.uniform();
    std::vector<bool> updates(random.below(20));
    for (std::size_t i = 0; i < updates.size(); ++i) updates[i] = random.chance(hit_share);
    return updates;
  };
  int num_wrong_later = 0;
  int num_wrong_beside = 0;
  constexpr int kNumVoxels = 2000;
  for (int i = 0; i < kNumVoxels; ++i) {
    const auto first = draw();
    const auto second = draw();
    const MilliLogOdds of_first = after_updates(0, first);
    const auto a = octree_of({{voxel_at(0), of_first}});
    const auto b = octree_of({{voxel_at(0), after_updates(0, second)}});
    const bool is_occupied = after_updates(of_first, second) >= 0;
    const auto later = merged(a, b, {.times = MergedTimes::kLater}).value();
    num_wrong_later += (log_odds_at(later, voxel_at(0)) >= 0) != is_occupied ? 1 : 0;
    num_wrong_beside +=
        (log_odds_at(merged(a, b).value(), voxel_at(0)) >= 0) != is_occupied ? 1 : 0;
  }
  EXPECT_LT(num_wrong_later, kNumVoxels / 20);
  EXPECT_LT(num_wrong_later, num_wrong_beside);
}

TEST(MergedOctree, LabelsTakeTheNamesOfTheMapThatIsAddedTo) {
  StoredLeaf leaf{.key = voxel_at(0), .log_odds = 847, .label = VoxelLabel{}};
  leaf.label->classes[0] = {0, 500};
  leaf.label->classes[1] = {1, 500};
  leaf.label->object = ObjectId{2};
  leaf.label->object_votes = 3;
  const OctreeMergeOptions names{.object_of = [](ObjectId id) { return ObjectId{id.value + 10}; },
                                 .class_of = [](ClassId id) { return ClassId{7 - id.value}; }};
  const auto label =
      merged(octree_of({}), octree_of({leaf}), names).value().stored_at(leaf.key)->label;
  EXPECT_EQ(label->object, ObjectId{12});
  // Equal evidence: the lower id first, which was the other one there.
  EXPECT_EQ(label->classes[0], (ClassWeight{6, 500}));
  EXPECT_EQ(label->classes[1], (ClassWeight{7, 500}));
  const auto of_none =
      merged(octree_of({}), octree_of({leaf}), {.object_of = [](ObjectId) { return kNoObject; }})
          .value()
          .stored_at(leaf.key)
          ->label;
  EXPECT_EQ(of_none->object, kNoObject);
  EXPECT_EQ(of_none->object_votes, 0);
}

TEST(MergedOctree, SpaceThatBothKnowToBeFreeTakesNoMemoryOfItsOwn) {
  std::vector<StoredLeaf> leaves;
  leaves.reserve(std::size_t{2048} * 8 * 8);
  for (int x = 0; x < 2048; ++x) {
    for (int y = 0; y < 8; ++y) {
      for (int z = 0; z < 8; ++z) leaves.push_back({voxel_at(x, y, z), -1200});
    }
  }
  const SemanticOctree free = merged(octree_of(leaves), octree_of(leaves)).value();
  EXPECT_EQ(log_odds_at(free, voxel_at(2047, 7, 7)), -2000);
  const SemanticOctree still = merged(free, free).value();
  EXPECT_TRUE(still == free);
  EXPECT_LE(still.memory_bytes(), free.memory_bytes());
  const SemanticOctree alone = merged(octree_of({}), free).value();
  EXPECT_TRUE(alone == free);
  EXPECT_LT(alone.memory_bytes(), octree_of(leaves).memory_bytes() / 2);
}

TEST(MergedOctree, MapsOfOtherStepsAreRefused) {
  const auto coarse = SemanticOctree::create({.resolution_m = 0.1}).value();
  const auto error = merged(octree_of({}), coarse).error();
  EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(error.field, "resolution_m");
  EXPECT_EQ(error.what, "must be that of the other map, 0.05, is 0.1");
  const auto wide =
      SemanticOctree::create({.sensor_model = {.clamp_max = Probability{0.99}}}).value();
  EXPECT_EQ(merged(octree_of({}), wide).error().field, "clamp_max");
}

}  // namespace
}  // namespace hypermap

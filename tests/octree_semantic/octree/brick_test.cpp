// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/brick.hpp"

#include "hypermap/octree_semantic/octree/brick_table.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace hypermap {
namespace {

TEST(BrickBits, AgreeWithASetOfNumbers) {
  std::mt19937 random(5);
  BrickBits bits;
  std::set<std::size_t> expected;
  for (int i = 0; i < 300; ++i) {
    const std::size_t cell = random() % kBrickVolume;
    if (random() % 4 == 0) {
      bits.reset(cell);
      expected.erase(cell);
    } else {
      bits.set(cell);
      expected.insert(cell);
    }
  }
  EXPECT_EQ(bits.count(), static_cast<int>(expected.size()));
  std::vector<std::size_t> visited;
  bits.for_each([&](std::size_t cell) { visited.push_back(cell); });
  EXPECT_EQ(visited, std::vector<std::size_t>(expected.begin(), expected.end()));
  for (std::size_t cell = 0; cell < kBrickVolume; ++cell) {
    EXPECT_EQ(bits.test(cell), expected.contains(cell));
    EXPECT_EQ(
        bits.rank(cell),
        static_cast<std::size_t>(std::distance(expected.begin(), expected.lower_bound(cell))));
  }
}

TEST(LabelTable, AgreesWithAMap) {
  std::mt19937 random(6);
  LabelTable table;
  std::map<std::size_t, std::uint32_t> expected;
  for (std::uint32_t i = 1; i < 2000; ++i) {
    const std::size_t cell = random() % kBrickVolume;
    if (random() % 3 == 0) {
      table.erase(cell);
      expected.erase(cell);
    } else {
      table.at(cell).object = ObjectId{i};
      expected[cell] = i;
    }
  }
  EXPECT_EQ(table.size(), expected.size());
  for (std::size_t cell = 0; cell < kBrickVolume; ++cell) {
    const VoxelLabel* found = table.find(cell);
    ASSERT_EQ(found != nullptr, expected.contains(cell));
    if (found == nullptr) continue;
    EXPECT_EQ(found->object, ObjectId{expected[cell]});
  }
}

TEST(BrickRef, OwnersShareUntilOneWrites) {
  BrickRef first = BrickRef::make();
  first.writable().known.set(7);
  BrickRef second = first;
  EXPECT_EQ(&*first, &*second);
  second.writable().known.set(8);
  EXPECT_NE(&*first, &*second);
  EXPECT_FALSE(first->known.test(8));
  EXPECT_TRUE(second->known.test(7));
  const Brick* alone = &*second;
  EXPECT_EQ(&second.writable(), alone) << "the only owner writes in place";
}

TEST(Brick, ContentIsTheSameWhetherLabelsAreEmptyOrMissing) {
  Brick a;
  Brick b;
  b.labels = std::make_unique<LabelTable>();
  EXPECT_TRUE(same_content(a, b));
  b.labels->at(3).object = ObjectId{1};
  EXPECT_FALSE(same_content(a, b));
}

TEST(BrickTable, FindsWhatWasMade) {
  std::mt19937_64 random(7);
  BrickTable table;
  std::map<std::uint64_t, std::uint32_t> expected;
  for (int i = 0; i < 5000; ++i) {
    const BrickKey key{random() % 100'000};
    const std::uint32_t position = table.prepare(key);
    expected.try_emplace(key.code, position);
    ASSERT_EQ(expected[key.code], position);
  }
  EXPECT_EQ(table.size(), expected.size());
  for (std::uint64_t code = 0; code < 100'000; ++code) {
    const auto found = expected.find(code);
    ASSERT_EQ(table.position(BrickKey{code}),
              found == expected.end() ? BrickTable::kNone : found->second);
  }
  std::vector<std::uint64_t> codes;
  for (const std::uint32_t position : table.in_morton_order()) {
    codes.push_back(table.key(position).code);
  }
  EXPECT_TRUE(std::is_sorted(codes.begin(), codes.end()));
}

constexpr MilliLogOdds kFreest = -2000;

void make_freest(Brick& brick) {
  brick.known.words.fill(~std::uint64_t{0});
  brick.log_odds.fill(kFreest);
}

TEST(BrickTable, BricksAsFreeAsCanBeShareOne) {
  BrickTable table(kFreest);
  for (std::uint64_t code = 0; code < 1000; ++code) {
    make_freest(table.writable(table.prepare(BrickKey{code})));
  }
  const std::size_t before = table.memory_bytes();
  for (std::uint32_t i = 0; i < 1000; ++i) table.share_if_freest(i);
  EXPECT_LT(table.memory_bytes(), before / 2);
  EXPECT_EQ(&table.brick(3), &table.brick(999));
  EXPECT_TRUE(table.is_freest(3));

  // Who only frees gets the shared one; who writes gets one of his own.
  EXPECT_EQ(table.prepare_to_free(BrickKey{3}), 3U);
  EXPECT_TRUE(table.is_freest(3));
  ASSERT_EQ(table.prepare(BrickKey{3}), 3U);
  EXPECT_FALSE(table.is_freest(3));
  table.writable(3).log_odds[5] = 100;
  EXPECT_EQ(table.brick(3).log_odds[4], kFreest);
  EXPECT_EQ(table.brick(4).log_odds[5], kFreest);
}

TEST(BrickTable, OnlyWhatIsKnownAndFreestAllOverIsShared) {
  BrickTable table(kFreest);
  for (std::uint64_t code = 0; code < 4; ++code) {
    make_freest(table.writable(table.prepare(BrickKey{code})));
  }
  table.writable(0).log_odds[511] = kFreest + 1;
  table.writable(1).known.reset(17);
  table.writable(2).labels = std::make_unique<LabelTable>();
  table.writable(2).labels->at(7).object = ObjectId{1};
  table.writable(3).labels = std::make_unique<LabelTable>();
  for (std::uint32_t i = 0; i < 4; ++i) table.share_if_freest(i);
  EXPECT_FALSE(table.is_freest(0));
  EXPECT_FALSE(table.is_freest(1));
  EXPECT_FALSE(table.is_freest(2));
  EXPECT_TRUE(table.is_freest(3)) << "an empty table of labels says nothing";
}

TEST(BrickTable, WhatACopySharesIsNotWrittenByTheOther) {
  BrickTable table(kFreest);
  for (std::uint64_t code = 0; code < 2; ++code) {
    make_freest(table.writable(table.prepare(BrickKey{code})));
    table.share_if_freest(static_cast<std::uint32_t>(code));
  }
  BrickTable copy = table;
  table.writable(table.prepare(BrickKey{0})).log_odds[0] = 1;
  copy.writable(copy.prepare(BrickKey{1})).log_odds[0] = 2;
  copy.writable(copy.prepare(BrickKey{0})).log_odds[1] = 3;
  EXPECT_EQ(table.brick(0).log_odds[0], 1);
  EXPECT_EQ(table.brick(0).log_odds[1], kFreest);
  EXPECT_TRUE(table.is_freest(1));
  EXPECT_EQ(copy.brick(0).log_odds[0], kFreest);
  EXPECT_EQ(copy.brick(0).log_odds[1], 3);
  EXPECT_EQ(copy.brick(1).log_odds[0], 2);
}

TEST(BrickTable, TellsWhatChangedSinceAMoment) {
  BrickTable table;
  for (std::uint64_t code = 0; code < 10; ++code) table.prepare(BrickKey{code});
  const auto change = [&table](std::initializer_list<std::uint32_t> positions) {
    table.reserve_changes(positions.size());
    for (const std::uint32_t position : positions) table.note_change(position);
    table.commit();
  };
  change({3, 1});
  const Revision first = table.revision();
  change({1, 5});
  EXPECT_EQ(table.changed_since(0), (std::vector<std::uint32_t>{1, 3, 5}));
  EXPECT_EQ(table.changed_since(first), (std::vector<std::uint32_t>{1, 5}));
  EXPECT_TRUE(table.changed_since(table.revision()).empty());
}

TEST(BrickTable, RemembersABoundedNumberOfChanges) {
  BrickTable table;
  for (std::uint64_t code = 0; code < 10; ++code) table.prepare(BrickKey{code});
  const std::size_t before = table.memory_bytes();
  for (int i = 0; i < 100'000; ++i) {
    table.reserve_changes(1);
    table.note_change(2);
    table.commit();
  }
  EXPECT_LT(table.memory_bytes(), before + 10'000);
  EXPECT_EQ(table.changed_since(table.revision() - 5), (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(table.changed_since(0).size(), 10U) << "too long ago: all may have changed";
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "octree/brick_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

namespace hypermap {
namespace {

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

constexpr MilliLogOdds kFullyFree = -2000;

void make_fully_free(Brick& brick) {
  brick.known.words.fill(~std::uint64_t{0});
  brick.log_odds.fill(kFullyFree);
}

TEST(BrickTable, BricksAsFreeAsCanBeShareOne) {
  BrickTable table(kFullyFree);
  for (std::uint64_t code = 0; code < 1000; ++code) {
    make_fully_free(table.writable(table.prepare(BrickKey{code})));
  }
  const std::size_t before = table.memory_bytes();
  for (std::uint32_t i = 0; i < 1000; ++i) table.share_if_fully_free(i);
  EXPECT_LT(table.memory_bytes(), before / 2);
  EXPECT_EQ(&table.brick(3), &table.brick(999));
  EXPECT_TRUE(table.is_fully_free(3));

  // Who only frees gets the shared one; who writes gets one of his own.
  EXPECT_EQ(table.prepare_to_free(BrickKey{3}), 3U);
  EXPECT_TRUE(table.is_fully_free(3));
  ASSERT_EQ(table.prepare(BrickKey{3}), 3U);
  EXPECT_FALSE(table.is_fully_free(3));
  table.writable(3).log_odds[5] = 100;
  EXPECT_EQ(table.brick(3).log_odds[4], kFullyFree);
  EXPECT_EQ(table.brick(4).log_odds[5], kFullyFree);
}

TEST(BrickTable, OnlyWhatIsKnownAndFreestAllOverIsShared) {
  BrickTable table(kFullyFree);
  for (std::uint64_t code = 0; code < 4; ++code) {
    make_fully_free(table.writable(table.prepare(BrickKey{code})));
  }
  table.writable(0).log_odds[511] = kFullyFree + 1;
  table.writable(1).known.reset(17);
  table.writable(2).labels = std::make_unique<LabelTable>();
  table.writable(2).labels->at(7).object = ObjectId{1};
  table.writable(3).labels = std::make_unique<LabelTable>();
  for (std::uint32_t i = 0; i < 4; ++i) table.share_if_fully_free(i);
  EXPECT_FALSE(table.is_fully_free(0));
  EXPECT_FALSE(table.is_fully_free(1));
  EXPECT_FALSE(table.is_fully_free(2));
  EXPECT_TRUE(table.is_fully_free(3)) << "an empty table of labels says nothing";
}

TEST(BrickTable, WhatACopySharesIsNotWrittenByTheOther) {
  BrickTable table(kFullyFree);
  for (std::uint64_t code = 0; code < 2; ++code) {
    make_fully_free(table.writable(table.prepare(BrickKey{code})));
    table.share_if_fully_free(static_cast<std::uint32_t>(code));
  }
  BrickTable copy = table;
  table.writable(table.prepare(BrickKey{0})).log_odds[0] = 1;
  copy.writable(copy.prepare(BrickKey{1})).log_odds[0] = 2;
  copy.writable(copy.prepare(BrickKey{0})).log_odds[1] = 3;
  EXPECT_EQ(table.brick(0).log_odds[0], 1);
  EXPECT_EQ(table.brick(0).log_odds[1], kFullyFree);
  EXPECT_TRUE(table.is_fully_free(1));
  EXPECT_EQ(copy.brick(0).log_odds[0], kFullyFree);
  EXPECT_EQ(copy.brick(0).log_odds[1], 3);
  EXPECT_EQ(copy.brick(1).log_odds[0], 2);
}

TEST(BrickTable, TellsWhatChangedSinceAMoment) {
  BrickTable table;
  for (std::uint64_t code = 0; code < 10; ++code) table.prepare(BrickKey{code});
  const auto change = [&table](std::initializer_list<std::uint32_t> positions) {
    for (const std::uint32_t position : positions) table.note_written(position, true);
    table.commit();
  };
  change({3, 1});
  const Revision first = table.revision();
  change({1, 5});
  EXPECT_EQ(table.changed_since(0), (std::vector<std::uint32_t>{1, 3, 5}));
  EXPECT_EQ(table.changed_since(first), (std::vector<std::uint32_t>{1, 5}));
  EXPECT_TRUE(table.changed_since(table.revision()).empty());
}

TEST(BrickTable, WhatWasWrittenWithoutChangeIsToldApart) {
  BrickTable table;
  for (std::uint64_t code = 0; code < 40; ++code) table.prepare(BrickKey{code});
  table.note_written(39, true);
  table.commit();
  const Revision first = table.revision();
  table.note_written(5, false);
  table.commit();
  EXPECT_TRUE(table.changed_since(first).empty());
  EXPECT_EQ(table.written_since(first), (std::vector<std::uint32_t>{5}));
  EXPECT_EQ(table.written_since(0), (std::vector<std::uint32_t>{5, 39}));
}

TEST(BrickTable, RemembersEveryChangeInTheSameMemory) {
  BrickTable table;
  for (std::uint64_t code = 0; code < 5000; ++code) table.prepare(BrickKey{code});
  const std::size_t before = table.memory_bytes();
  for (int i = 0; i < 100'000; ++i) {
    table.note_written(2, true);
    if (i == 0) table.note_written(4000, true);
    table.commit();
  }
  EXPECT_EQ(table.memory_bytes(), before);
  EXPECT_EQ(table.changed_since(table.revision() - 5), (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(table.changed_since(0), (std::vector<std::uint32_t>{2, 4000}));
}

/// Writes to some bricks of a table, as a frame does.
void write_some(BrickTable& table, std::mt19937_64& random, std::uint64_t num_codes) {
  for (int i = 0; i < 50; ++i) {
    const std::uint32_t position = table.prepare(BrickKey{random() % num_codes});
    Brick& brick = table.writable(position);
    const std::size_t cell = random() % kBrickVolume;
    brick.known.set(cell);
    brick.log_odds[cell] = static_cast<MilliLogOdds>(random() % 1000);
    if (cell % 4 == 0) {
      if (!brick.labels) brick.labels = std::make_unique<LabelTable>();
      brick.labels->at(cell).object = ObjectId{static_cast<std::uint32_t>(random() % 100)};
    }
    table.note_written(position, true);
  }
  table.commit();
}

bool same_bricks(const BrickTable& a, const BrickTable& b) {
  if (a.size() != b.size() || a.revision() != b.revision()) return false;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    if (a.key(i) != b.key(i) || !same_content(a.brick(i), b.brick(i))) return false;
    if (b.position(a.key(i)) != i) return false;
  }
  return a.changed_since(a.revision() / 2) == b.changed_since(b.revision() / 2);
}

TEST(BrickTable, CopiesOfEveryMomentStayWhatTheyWere) {
  // The same writes once without any copy, and once with copies held for a while.
  std::vector<BrickTable> expected;
  expected.reserve(60);
  for (std::size_t num_rounds = 0; num_rounds < 60; ++num_rounds) {
    BrickTable& alone = expected.emplace_back(kFullyFree);
    std::mt19937_64 random(3);
    for (std::size_t i = 0; i < num_rounds; ++i) write_some(alone, random, 3000);
  }
  std::mt19937_64 random(3);
  BrickTable table(kFullyFree);
  std::map<std::size_t, std::unique_ptr<BrickTable>> held;
  for (std::size_t round = 0; round < expected.size(); ++round) {
    ASSERT_TRUE(same_bricks(table, expected[round]));
    held[round] = std::make_unique<BrickTable>(table);
    for (const auto& [moment, copy] : held) {
      ASSERT_TRUE(same_bricks(*copy, expected[moment])) << moment << " after " << round;
    }
    held.erase(round * 7 % 11);
    if (held.size() > 5) held.erase(held.begin());
    write_some(table, random, 3000);
  }
}

TEST(BrickTable, AWriteBesideACopyCopiesNoMoreThanItTouches) {
  BrickTable table(kFullyFree);
  for (std::uint64_t code = 0; code < 10'000; ++code) {
    table.writable(table.prepare(BrickKey{code})).known.set(1);
  }
  const BrickTable copy = table;
  table.writable(table.prepare(BrickKey{77})).known.set(2);
  int num_different = 0;
  for (std::uint32_t i = 0; i < table.size(); ++i) {
    if (&table.brick(i) != &copy.brick(i)) ++num_different;
  }
  EXPECT_EQ(num_different, 1);
}

TEST(BrickTable, BricksOfDroppedCopiesServeTheNextWrites) {
  BrickTable table(kFullyFree);
  for (std::uint64_t code = 0; code < 2000; ++code) table.prepare(BrickKey{code});
  const auto touch_all = [&table] {
    for (std::uint64_t code = 0; code < 2000; ++code) table.prepare(BrickKey{code});
    table.commit();
  };
  touch_all();
  const std::size_t alone = table.memory_bytes();
  std::set<const Brick*> seen;
  for (int round = 0; round < 10; ++round) {
    // As a snapshot holds it. NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
    const BrickTable held = table;
    touch_all();
    EXPECT_EQ(held.size(), table.size());
    for (std::uint32_t i = 0; i < table.size(); ++i) seen.insert(&table.brick(i));
  }
  EXPECT_LE(seen.size(), 3U * 2000U);
  EXPECT_LE(table.memory_bytes(), 2 * alone + 100'000);
  for (int i = 0; i < 200; ++i) touch_all();
  table.prepare(BrickKey{5000});
  const BrickTable last = table;
  EXPECT_LE(table.memory_bytes(), 2 * alone + 100'000);
}

}  // namespace
}  // namespace hypermap

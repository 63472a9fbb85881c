// SPDX-License-Identifier: BSD-3-Clause
#include "octree/brick.hpp"

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
  b.labels->at(3) = {};
  EXPECT_TRUE(same_content(a, b)) << "a blank label is none";
  EXPECT_TRUE(same_content(b, a));
  b.labels->at(3).object = ObjectId{1};
  EXPECT_FALSE(same_content(a, b));
  EXPECT_FALSE(same_content(b, a));
  a.labels = std::make_unique<LabelTable>();
  a.labels->at(3).object = ObjectId{1};
  a.labels->at(5) = {};
  EXPECT_TRUE(same_content(a, b)) << "the blank one is another's cell";
  a.labels->at(5).object_votes = 1;
  EXPECT_FALSE(same_content(a, b));
}

}  // namespace
}  // namespace hypermap

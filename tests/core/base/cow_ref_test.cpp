// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/cow_ref.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace hypermap {
namespace {

struct Number {
  int value = 0;
  OwnerCount owners;
};

TEST(CowRef, OwnersShareUntilOneWrites) {
  auto first = CowRef<Number>::make();
  first.writable().value = 7;
  CowRef<Number> second = first;
  EXPECT_TRUE(first.shares(second));
  EXPECT_FALSE(first.is_sole());
  second.writable().value = 8;
  EXPECT_EQ(first->value, 7);
  EXPECT_EQ(second->value, 8);
  EXPECT_TRUE(first.is_sole());
  const Number* alone = &*second;
  EXPECT_EQ(&second.writable(), alone) << "the only owner writes in place";
}

TEST(CowRef, NullIsCopiedAndMoved) {
  CowRef<Number> null;
  const CowRef<Number> copy = null;
  EXPECT_FALSE(copy);
  null = CowRef<Number>::make();
  const CowRef<Number> moved = std::move(null);
  EXPECT_TRUE(moved);
  EXPECT_TRUE(moved.is_sole());
}

TEST(CowRef, AWriterBesideReadersNeverChangesWhatTheySee) {
  auto mine = CowRef<Number>::make();
  for (int round = 0; round < 50; ++round) {
    mine.writable().value = round;
    std::vector<std::thread> readers;
    readers.reserve(4);
    for (int i = 0; i < 4; ++i) {
      readers.emplace_back([theirs = mine, round]() mutable {
        EXPECT_EQ(theirs->value, round);
        theirs.writable().value = -1;
      });
    }
    mine.writable().value = round + 1000;
    for (std::thread& reader : readers) reader.join();
    EXPECT_EQ(mine->value, round + 1000);
  }
}

}  // namespace
}  // namespace hypermap

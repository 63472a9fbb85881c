// SPDX-License-Identifier: BSD-3-Clause
#include "octree/brick_pool.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

TEST(BrickPool, GivesBackWhatItGot) {
  BrickPool pool;
  const Brick* first = nullptr;
  {
    BrickRef brick = pool.make_blank();
    first = &*brick;
    brick.sole().known.set(3);
    brick.sole().log_odds[3] = 7;
    brick.sole().labels = std::make_unique<LabelTable>();
  }
  EXPECT_EQ(pool.num_idle(), 1U);
  const BrickRef again = pool.make_blank();
  EXPECT_EQ(&*again, first);
  EXPECT_TRUE(same_content(*again, Brick())) << "nothing is left of what it was";
  EXPECT_EQ(pool.num_idle(), 0U);
}

TEST(BrickPool, CopiesAreWhole) {
  BrickPool pool;
  BrickRef source = pool.make_blank();
  source.sole().known.set(3);
  source.sole().occupied.set(3);
  source.sole().log_odds[3] = 700;
  source.sole().labels = std::make_unique<LabelTable>();
  source.sole().labels->at(3).object = ObjectId{5};
  const BrickRef copy = pool.make_copy(*source);
  EXPECT_FALSE(copy.shares(source));
  EXPECT_TRUE(same_content(*copy, *source));
  EXPECT_TRUE(copy->occupied.test(3));
}

TEST(BrickPool, KeepsABoundedNumber) {
  BrickPool pool;
  pool.set_capacity(10);
  std::vector<BrickRef> bricks;
  bricks.reserve(30);
  for (int i = 0; i < 30; ++i) bricks.push_back(pool.make_blank());
  bricks.clear();
  EXPECT_EQ(pool.num_idle(), 10U);
}

TEST(BrickPool, ServesAnyNumberOfThreads) {
  BrickPool pool;
  pool.set_capacity(1000);
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&pool, t] {
      std::vector<BrickRef> mine;
      for (int i = 0; i < 2000; ++i) {
        mine.push_back(pool.make_blank());
        Brick& brick = mine.back().sole();
        ASSERT_FALSE(brick.known.any());
        brick.known.set(static_cast<std::size_t>(t));
        if (i % 10 == t) mine.clear();
      }
      for (const BrickRef& brick : mine) ASSERT_EQ(brick->known.count(), 1);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_LE(pool.num_idle(), 1000U);
  std::vector<BrickRef> all;
  std::set<const Brick*> distinct;
  for (std::size_t i = 0; i < 1100; ++i) distinct.insert(&*all.emplace_back(pool.make_blank()));
  EXPECT_EQ(distinct.size(), 1100U);
}

}  // namespace
}  // namespace hypermap

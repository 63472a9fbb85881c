// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/load_budget.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace hypermap {
namespace {

TEST(LoadBudget, WithoutLimitsEverythingPasses) {
  const LoadBudget budget;
  EXPECT_TRUE(budget.draw_pixels(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_TRUE(budget.draw_pixels(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_TRUE(budget.check_stop());
}

TEST(LoadBudget, ManySmallThingsMeetTheLimitThatOneWouldMeet) {
  const LoadBudget budget({.max_pixels = 10});
  EXPECT_TRUE(budget.draw_pixels(4));
  EXPECT_TRUE(budget.draw_pixels(6)) << "the limit itself passes";
  const auto refused = budget.draw_pixels(1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_EQ(refused.error().what,
            "brings the images to 11 pixels, the limit for all together is 10 (max_pixels)");
}

TEST(LoadBudget, WhatIsRefusedIsNotDrawn) {
  const LoadBudget budget({.max_opaque_bytes = 10});
  EXPECT_FALSE(budget.draw_opaque_bytes(11));
  EXPECT_TRUE(budget.draw_opaque_bytes(10));
}

TEST(LoadBudget, EachSumHasItsOwnLimit) {
  const LoadBudget budget(
      {.max_pixels = 1, .max_edge_tests = 2, .max_opaque_bytes = 3, .max_octree_nodes = 4});
  EXPECT_TRUE(budget.draw_pixels(1));
  EXPECT_TRUE(budget.draw_edge_tests(2));
  EXPECT_TRUE(budget.draw_opaque_bytes(3));
  EXPECT_TRUE(budget.draw_octree_nodes(4));
  EXPECT_FALSE(budget.draw_pixels(1));
  EXPECT_FALSE(budget.draw_edge_tests(1));
  EXPECT_FALSE(budget.draw_opaque_bytes(1));
  EXPECT_FALSE(budget.draw_octree_nodes(1));
}

TEST(LoadBudget, ACopyDrawsOnTheSameAccount) {
  const LoadBudget budget({.max_edge_tests = 5});
  const LoadBudget copy = budget;  // NOLINT(performance-unnecessary-copy-initialization)
  EXPECT_TRUE(copy.draw_edge_tests(4));
  EXPECT_FALSE(budget.draw_edge_tests(2));
}

TEST(LoadBudget, AStopEndsEveryDraw) {
  bool stopped = false;
  const LoadBudget budget(BudgetLimits{}, [&stopped] { return stopped; });
  EXPECT_TRUE(budget.draw_pixels(1));
  stopped = true;
  EXPECT_EQ(budget.check_stop().error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(budget.draw_pixels(1).error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(budget.draw_edge_tests(1).error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(budget.draw_opaque_bytes(1).error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(budget.draw_octree_nodes(1).error().code, ErrorCode::kInterrupted);
}

}  // namespace
}  // namespace hypermap

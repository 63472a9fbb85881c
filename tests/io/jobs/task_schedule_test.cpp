// SPDX-License-Identifier: BSD-3-Clause
#include "task_schedule.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace hypermap {
namespace {

/// 7 and 8, and 9 of both.
std::vector<CrewTask> pair_and_whole() {
  return {{.number = 7}, {.number = 8}, {.number = 9, .needs = {7, 8}}};
}

TEST(TaskSchedule, HandsOutWhatNeedsNothingElseInOrder) {
  const auto tasks = pair_and_whole();
  TaskSchedule schedule(tasks);
  EXPECT_EQ(schedule.next(), 7U);
  EXPECT_EQ(schedule.next(), 8U);
  EXPECT_EQ(schedule.next(), std::nullopt);
  EXPECT_FALSE(schedule.is_over());
  schedule.finish(8, true);
  EXPECT_EQ(schedule.next(), std::nullopt);
  schedule.finish(7, true);
  EXPECT_FALSE(schedule.is_over());
  EXPECT_EQ(schedule.next(), 9U);
  schedule.finish(9, true);
  EXPECT_TRUE(schedule.is_over());
}

TEST(TaskSchedule, WhatNeedsAFailedTaskIsNeverHandedOut) {
  const auto tasks = pair_and_whole();
  TaskSchedule schedule(tasks);
  EXPECT_EQ(schedule.next(), 7U);
  schedule.finish(7, false);
  EXPECT_EQ(schedule.next(), 8U) << "others go on";
  schedule.finish(8, true);
  EXPECT_EQ(schedule.next(), std::nullopt);
  EXPECT_TRUE(schedule.is_over());
}

TEST(TaskSchedule, OnceStoppedItIsOverWhenWhatIsAtWorkIsDone) {
  const auto tasks = pair_and_whole();
  TaskSchedule schedule(tasks);
  EXPECT_EQ(schedule.next(), 7U);
  schedule.stop();
  EXPECT_EQ(schedule.next(), std::nullopt);
  EXPECT_FALSE(schedule.is_over());
  schedule.finish(7, true);
  EXPECT_TRUE(schedule.is_over());
}

TEST(TaskSchedule, OfNothingIsOver) {
  const TaskSchedule schedule({});
  EXPECT_TRUE(schedule.is_over());
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "shared_schedule.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

const TaskDone kTellsNobody;

TEST(SharedSchedule, WaitsForWhatMayBecomeReady) {
  const std::vector<CrewTask> tasks{{.number = 1}, {.number = 2, .needs = {1}}};
  SharedSchedule schedule(tasks, kTellsNobody);
  EXPECT_EQ(schedule.wait_for_next(), 1U);
  EXPECT_EQ(schedule.take_next(), std::nullopt);
  std::optional<std::size_t> taken;
  std::thread waits([&] { taken = schedule.wait_for_next(); });
  schedule.finish({.number = 1});
  waits.join();
  EXPECT_EQ(taken, 2U);
  EXPECT_FALSE(schedule.is_over());
  schedule.finish({.number = 2});
  EXPECT_TRUE(schedule.is_over());
  EXPECT_EQ(schedule.wait_for_next(), std::nullopt);
}

TEST(SharedSchedule, LetsWaitingThreadsGoWhenItIsStopped) {
  const std::vector<CrewTask> tasks{{.number = 1}, {.number = 2, .needs = {1}}};
  SharedSchedule schedule(tasks, kTellsNobody);
  EXPECT_EQ(schedule.take_next(), 1U);
  std::thread waits([&] { EXPECT_EQ(schedule.wait_for_next(), std::nullopt); });
  schedule.stop();
  schedule.finish({.number = 1});
  waits.join();
  EXPECT_TRUE(schedule.is_over());
}

TEST(SharedSchedule, TellsOutcomesByTheirNumbersAndWhoseTheyAre) {
  const std::vector<CrewTask> tasks{{.number = 5}, {.number = 3}};
  SharedSchedule schedule(tasks, kTellsNobody);
  work_through(
      schedule, [](std::size_t number) { return TaskOutcome{.number = number}; }, 7);
  const auto outcomes = schedule.outcomes();
  ASSERT_EQ(outcomes.size(), 2U);
  EXPECT_EQ(outcomes[0].number, 3U);
  EXPECT_EQ(outcomes[1].number, 5U);
  EXPECT_EQ(outcomes[0].worker, 7U);
}

}  // namespace
}  // namespace hypermap

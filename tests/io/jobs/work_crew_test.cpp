// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/work_crew.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <mutex>
#include <set>
#include <vector>

namespace hypermap {
namespace {

/// Ten tasks, and one that needs them all.
std::vector<CrewTask> ten_and_one() {
  std::vector<CrewTask> tasks;
  CrewTask last{.number = 10};
  for (std::size_t i = 0; i < 10; ++i) {
    tasks.push_back({.number = i});
    last.needs.push_back(i);
  }
  tasks.push_back(last);
  return tasks;
}

TEST(ThreadCrew, DoesEachTaskOnceAfterThoseThatItNeeds) {
  for (const std::size_t num_workers : {1U, 2U, 5U, 20U}) {
    ThreadCrew crew(num_workers);
    std::atomic<std::size_t> num_before_last = 0;
    std::mutex mutex;
    std::multiset<std::size_t> begun;
    const auto work = [&](std::size_t number) {
      const std::scoped_lock lock(mutex);
      if (number == 10) num_before_last = begun.size();
      begun.insert(number);
      return TaskOutcome{.number = number, .note = "done"};
    };
    std::size_t num_told = 0;
    const auto outcomes = crew.run(ten_and_one(), work, [&](const TaskOutcome&) {
      ++num_told;
      return true;
    });
    ASSERT_TRUE(outcomes);
    ASSERT_EQ(outcomes->size(), 11U);
    EXPECT_EQ(num_before_last, 10U);
    EXPECT_EQ(num_told, 11U);
    for (std::size_t i = 0; i < 11; ++i) {
      EXPECT_EQ(begun.count(i), 1U);
      EXPECT_EQ((*outcomes)[i].number, i);
      EXPECT_EQ((*outcomes)[i].note, "done");
      EXPECT_LT((*outcomes)[i].worker, num_workers);
    }
  }
}

TEST(ThreadCrew, OthersGoOnWhenATaskFails) {
  ThreadCrew crew(3);
  const auto work = [](std::size_t number) {
    TaskOutcome outcome{.number = number};
    if (number == 4) outcome.error = Error{.what = "broken"};
    return outcome;
  };
  const auto outcomes = crew.run(ten_and_one(), work, {});
  ASSERT_TRUE(outcomes);
  ASSERT_EQ(outcomes->size(), 10U) << "the last needs the one that failed";
  EXPECT_EQ((*outcomes)[4].error->what, "broken");
  EXPECT_FALSE((*outcomes)[9].error);
}

TEST(ThreadCrew, BeginsNothingMoreWhenToldSo) {
  ThreadCrew crew(1);
  const auto work = [](std::size_t number) { return TaskOutcome{.number = number}; };
  const auto outcomes =
      crew.run(ten_and_one(), work, [](const TaskOutcome& outcome) { return outcome.number < 3; });
  ASSERT_TRUE(outcomes);
  EXPECT_EQ(outcomes->size(), 4U);
}

TEST(ThreadCrew, HasNothingToDoWithoutTasks) {
  ThreadCrew crew(2);
  const auto outcomes = crew.run({}, [](std::size_t) { return TaskOutcome{}; }, {});
  ASSERT_TRUE(outcomes);
  EXPECT_TRUE(outcomes->empty());
}

}  // namespace
}  // namespace hypermap

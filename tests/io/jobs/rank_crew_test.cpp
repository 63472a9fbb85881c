// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/rank_crew.hpp"

#include "memory_ports.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;

/// Tasks 0 .. 7 and, of all of these, 8.
std::vector<CrewTask> eight_and_one() {
  std::vector<CrewTask> tasks;
  CrewTask last{.number = 8};
  for (std::size_t i = 0; i < 8; ++i) {
    tasks.push_back({.number = i});
    last.needs.push_back(i);
  }
  tasks.push_back(last);
  return tasks;
}

/// The other ranks as threads, at these jobs.
class OtherRanks {
 public:
  OtherRanks(test::MemoryMail& mail,
             const std::vector<Result<std::string>>& jobs,
             const TaskWork& work) {
    for (std::size_t i = 0; i < jobs.size(); ++i) {
      threads_.emplace_back([&mail, i, job = jobs[i], &work] {
        test::MemoryPort port(mail, i + 1);
        serve_rank(port, job, work);
      });
    }
  }
  ~OtherRanks() {
    for (std::thread& thread : threads_) thread.join();
  }
  OtherRanks(const OtherRanks&) = delete;
  OtherRanks& operator=(const OtherRanks&) = delete;
  OtherRanks(OtherRanks&&) = delete;
  OtherRanks& operator=(OtherRanks&&) = delete;

 private:
  std::vector<std::thread> threads_;
};

TEST(RankCrew, AllRanksDoTasksAndAreLetGo) {
  for (const std::size_t num_ranks : {1U, 2U, 4U, 20U}) {
    test::MemoryMail mail(num_ranks);
    test::MemoryPort port(mail, 0);
    std::mutex mutex;
    std::multiset<std::size_t> begun;
    const TaskWork work = [&](std::size_t number) {
      const std::scoped_lock lock(mutex);
      EXPECT_TRUE(number != 8 || begun.size() == 8) << "the last needs the others";
      begun.insert(number);
      return TaskOutcome{.number = number, .note = "of " + std::to_string(number)};
    };
    const OtherRanks others(mail, std::vector<Result<std::string>>(num_ranks - 1, "job"), work);
    RankCrew crew(port, "job");
    EXPECT_EQ(crew.num_workers(), num_ranks);
    std::size_t num_told = 0;
    const auto outcomes = crew.run(eight_and_one(), work, [&](const TaskOutcome&) {
      ++num_told;
      return true;
    });
    ASSERT_TRUE(outcomes) << to_string(outcomes.error());
    ASSERT_EQ(outcomes->size(), 9U);
    EXPECT_EQ(num_told, 9U);
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_EQ(begun.count(i), 1U);
      EXPECT_EQ((*outcomes)[i].note, "of " + std::to_string(i));
      EXPECT_LT((*outcomes)[i].worker, num_ranks);
    }
    const auto more = crew.run(std::vector<CrewTask>{{.number = 9}}, work, {});
    ASSERT_TRUE(more) << "a crew goes on with other tasks";
    EXPECT_EQ(more->size(), 1U);
  }
}

TEST(RankCrew, ErrorsOfTasksComeBackWhole) {
  test::MemoryMail mail(2);
  test::MemoryPort port(mail, 0);
  const Error error{.code = ErrorCode::kLimit,
                    .what = "too \"many\"\n",
                    .file = "a.hmap",
                    .entry = "b",
                    .field = "c",
                    .line = 7};
  const TaskWork work = [&](std::size_t number) {
    return TaskOutcome{.number = number, .error = error, .wall_s = 0.5, .peak_rss_bytes = 9};
  };
  const OtherRanks others(mail, {Result<std::string>("job")}, work);
  RankCrew crew(port, "job");
  const auto outcomes = crew.run(eight_and_one(), work, {});
  ASSERT_TRUE(outcomes);
  ASSERT_EQ(outcomes->size(), 8U);
  for (const TaskOutcome& outcome : *outcomes) {
    EXPECT_EQ(to_string(*outcome.error), to_string(error));
    EXPECT_EQ(outcome.error->code, ErrorCode::kLimit);
    EXPECT_EQ(outcome.peak_rss_bytes, 9U);
  }
}

/// What a crew of two says whose other rank is at `job`.
std::string refusal_by(const Result<std::string>& job) {
  test::MemoryMail mail(2);
  test::MemoryPort port(mail, 0);
  const TaskWork work = [](std::size_t number) { return TaskOutcome{.number = number}; };
  const OtherRanks others(mail, {job}, work);
  test::wait_for_mail(mail, 0, 1);
  RankCrew crew(port, "job");
  const auto outcomes = crew.run(std::vector<CrewTask>{{.number = 0}}, work, {});
  return outcomes ? "done" : to_string(outcomes.error());
}

TEST(RankCrew, ARankAtAnotherJobOrNoneEndsTheWork) {
  EXPECT_EQ(refusal_by("job"), "done");
  EXPECT_THAT(refusal_by("another"), HasSubstr("rank 1: has another list"));
  EXPECT_THAT(refusal_by(fail(ErrorCode::kIo, "is not there", "list")),
              HasSubstr("rank 1: is not there"));
}

TEST(RankCrew, LetsTheOthersGoThoughItNeverRan) {
  test::MemoryMail mail(3);
  test::MemoryPort port(mail, 0);
  const TaskWork work = [](std::size_t number) { return TaskOutcome{.number = number}; };
  const OtherRanks others(mail, std::vector<Result<std::string>>(2, "job"), work);
  const RankCrew crew(port, "job");
}

}  // namespace
}  // namespace hypermap

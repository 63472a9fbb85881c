// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/map_many_ranks.hpp"

#include "memory_ports.hpp"
#include "rooms.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;

/// What rank 0 gives of so many ranks, at these jobs.
Result<MapManyReport> by_ranks(const std::vector<Result<MapManyJob>>& jobs) {
  test::MemoryMail mail(jobs.size());
  std::vector<std::thread> others;
  for (std::size_t rank = 1; rank < jobs.size(); ++rank) {
    others.emplace_back([&, rank] {
      test::MemoryPort port(mail, rank);
      const auto report = run_map_many_by_ranks(jobs[rank], port);
      EXPECT_TRUE(report && !*report) << "rank 0 tells of it";
    });
  }
  test::wait_for_mail(mail, 0, jobs.size() - 1);
  test::MemoryPort port(mail, 0);
  auto report = run_map_many_by_ranks(jobs.front(), port);
  for (std::thread& other : others) other.join();
  if (!report) return Unexpected(report.error());
  return **std::move(report);
}

TEST(MapManyRanks, GiveTheBytesOfOneRank) {
  const test::TempDir folder;
  const auto sequences = test::write_rooms(folder.path(), 5);
  std::string bytes;
  for (const std::size_t num_ranks : {1U, 2U, 4U}) {
    const MapManyJob job = test::job_of_rooms(sequences, folder / std::to_string(num_ranks));
    const auto report = by_ranks(std::vector<Result<MapManyJob>>(num_ranks, job));
    ASSERT_TRUE(report) << to_string(report.error());
    EXPECT_EQ(report->workers.size(), num_ranks);
    EXPECT_EQ(report->num_merges, 4U);
    if (num_ranks == 1) bytes = test::bytes_of(job.output);
    EXPECT_EQ(test::bytes_of(job.output), bytes);
  }
}

TEST(MapManyRanks, AtDifferentJobsAreRefused) {
  const test::TempDir folder;
  const auto sequences = test::write_rooms(folder.path(), 2);
  const MapManyJob job = test::job_of_rooms(sequences, folder / "map");
  MapManyJob other = job;
  other.mapping.mapper.octree.resolution_m = 0.1;
  const auto refused = by_ranks({job, other});
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("rank 1: has another list"));
  const auto unread = by_ranks({fail(ErrorCode::kIo, "is not there", "list"), job});
  ASSERT_FALSE(unread);
  EXPECT_EQ(unread.error().code, ErrorCode::kIo);
}

}  // namespace
}  // namespace hypermap

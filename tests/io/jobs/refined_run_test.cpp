// SPDX-License-Identifier: BSD-3-Clause
// Refinement of given poses in a whole job.
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

MappingJob refining_job(const test::TempDir& folder) {
  test::write_tum(folder / "dataset");
  MappingJob job{.input = folder / "dataset", .output = folder / "a.hmap"};
  job.mapper.num_threads = 1;
  job.mapper.refinement.rule = PoseRefinementRule::kPointToPlane;
  return job;
}

std::size_t num_poses(const PoseCounts& poses) {
  return poses.num_refined + poses.num_too_few_points + poses.num_ambiguous + poses.num_too_large +
         poses.num_no_better;
}

TEST(RefinedRun, SaysWhatBecameOfEachPose) {
  const test::TempDir folder;
  MappingJob job = refining_job(folder);
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(num_poses(report->poses), report->num_frames);
  EXPECT_THAT(to_json(*report), HasSubstr("\"too_few_points\": "));
  job.mapper.refinement.rule = PoseRefinementRule::kNone;
  EXPECT_EQ(num_poses(run_mapping(job)->poses), 0U);
}

TEST(RefinedRun, GoesOnByTheFramesBeforeTheCheckpoint) {
  const test::TempDir folder;
  MappingJob job = refining_job(folder);
  job.checkpoint_every = 1;
  ASSERT_TRUE(run_mapping(job));
  const std::string uninterrupted = content_of(job.output);
  ASSERT_FALSE(run_mapping(job, [](std::size_t done, std::size_t) { return done < 2; }));
  job.resume = true;
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_resumed, 2U);
  EXPECT_EQ(num_poses(report->poses), report->num_frames) << "those before the checkpoint too";
  EXPECT_EQ(content_of(job.output), uninterrupted);
}

}  // namespace
}  // namespace hypermap

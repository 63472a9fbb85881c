// SPDX-License-Identifier: BSD-3-Clause
// Runs whose network looks at some of the frames.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "look_schedule.hpp"
#include "support/sanitized.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"
#include "support/tiny_onnx.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::TempDir;
using ::testing::HasSubstr;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Four frames, the camera a metre further each time, and a network that sees a chair in each.
MappingJob job_with_network(const TempDir& folder) {
  test::write_tum(folder / "dataset");
  test::write_text(
      folder / "m.onnx",
      test::tiny_onnx(32, 32, {{"detection_out", {1, 1, 1, 7}, {0, 1, 0.9F, 0, 0, 0.8F, 1}}}));
  MappingJob job{.input = folder / "dataset", .output = folder / "a.hmap"};
  job.model = folder / "m.onnx";
  job.detector.class_names = {"chair", "table"};
  job.mapper.num_threads = 1;
  job.dataset.read_color = true;
  return job;
}

MappingJob with_looks(MappingJob job, const LookOptions& looks) {
  job.looks = looks;
  return job;
}

const LookOptions kEverySecond{.every = 2};
/// The cameras stand 1 m apart: frames 0 and 2.
const LookOptions kFarKeyframes{.rule = LookRule::kKeyframes, .min_distance_m = 1.5};

TEST(DetectorLooks, AreCountedAndWhatIsNotLookedAtIsMappedAllTheSame) {
  const TempDir folder;
  const MappingJob job = job_with_network(folder);
  const auto all = run_mapping(job);
  ASSERT_TRUE(all) << to_string(all.error());
  EXPECT_EQ(all->num_looks, 4U);
  EXPECT_EQ(all->num_detections, 4U);
  for (const LookOptions& looks : {kEverySecond, kFarKeyframes}) {
    const auto some = run_mapping(with_looks(job, looks));
    ASSERT_TRUE(some) << to_string(some.error());
    EXPECT_EQ(some->num_frames, 4U);
    EXPECT_EQ(some->num_looks, 2U);
    EXPECT_EQ(some->num_detections, 2U);
    EXPECT_EQ(some->points.num_hits, all->points.num_hits);
    EXPECT_EQ(some->num_visibility_skipped, all->num_visibility_skipped + 2);
    EXPECT_THAT(to_json(*some), HasSubstr("\"frames_looked_at\": 2"));
  }
}

TEST(DetectorLooks, WithDetectionsOnFileEachFrameIsLookedAt) {
  const TempDir folder;
  MappingJob job = with_looks(job_with_network(folder), kEverySecond);
  test::write_text(folder / "found.jsonl", test::chair_in("rgb/102.010.pgm"));
  job.dataset.detections = {folder / "found.jsonl"};
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_looks, 2U);
  EXPECT_EQ(report->num_visibility_skipped, 0U);
}

TEST(DetectorLooks, AreTheSameAfterAnInterruptionAndOnAnyThreads) {
  const TempDir folder;
  for (const LookOptions& looks : {kEverySecond, kFarKeyframes}) {
    MappingJob job = with_looks(job_with_network(folder), looks);
    job.checkpoint_every = 1;
    const auto whole = run_mapping(job);
    ASSERT_TRUE(whole) << to_string(whole.error());
    const std::string bytes = bytes_of(job.output);
    // The thread sanitizer has nothing to find where one thread works, and all in one interruption.
    for (const int num_threads : test::kThreadSanitized ? std::vector{3} : std::vector{1, 3}) {
      job.mapper.num_threads = num_threads;
      job.resume = false;
      ASSERT_TRUE(run_mapping(job));
      EXPECT_EQ(bytes_of(job.output), bytes) << num_threads;
      const std::size_t first = test::kThreadSanitized ? 3 : 1;
      for (std::size_t num_frames = first; num_frames < 4; ++num_frames) {
        job.resume = false;
        ASSERT_FALSE(
            run_mapping(job, [&](std::size_t done, std::size_t) { return done < num_frames; }));
        job.resume = true;
        const auto resumed = run_mapping(job);
        ASSERT_TRUE(resumed) << to_string(resumed.error());
        EXPECT_EQ(bytes_of(job.output), bytes) << num_frames;
        EXPECT_EQ(resumed->num_looks, whole->num_looks);
        EXPECT_EQ(resumed->num_detections, whole->num_detections);
      }
    }
  }
}

TEST(DetectorLooks, AnotherScheduleIsAnotherRun) {
  const TempDir folder;
  MappingJob job = with_looks(job_with_network(folder), kEverySecond);
  job.checkpoint_every = 1;
  ASSERT_FALSE(run_mapping(job, [](std::size_t done, std::size_t) { return done < 2; }));
  job.resume = true;
  const auto refused = run_mapping(with_looks(job, kFarKeyframes));
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("detect.rule: is keyframes"));
}

TEST(DetectorLooks, BeginAnewWithEachRunThatAppends) {
  const TempDir folder;
  MappingJob job = with_looks(job_with_network(folder), kFarKeyframes);
  ASSERT_TRUE(run_mapping(job));
  job.append = true;
  job.same_world = true;
  job.force = true;
  const auto second = run_mapping(job);
  ASSERT_TRUE(second) << to_string(second.error());
  EXPECT_EQ(second->num_looks, 2U);
}

}  // namespace
}  // namespace hypermap

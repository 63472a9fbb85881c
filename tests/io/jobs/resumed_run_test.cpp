// SPDX-License-Identifier: BSD-3-Clause
#include "resumed_run.hpp"

#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/sanitized.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Four frames, a chair in the third.
MappingJob job_in(const TempDir& folder) {
  test::write_tum(folder / "dataset");
  test::write_text(folder / "found.jsonl", test::chair_in("rgb/102.010.pgm"));
  MappingJob job{.input = folder / "dataset", .output = folder / "a.hmap"};
  job.dataset.detections = {folder / "found.jsonl"};
  job.mapper.num_threads = 1;
  job.checkpoint_every = 1;
  return job;
}

/// Ends the run after `num_frames` frames.
void interrupt(const MappingJob& job, std::size_t num_frames) {
  const auto ended =
      run_mapping(job, [&](std::size_t done, std::size_t) { return done < num_frames; });
  ASSERT_FALSE(ended);
  ASSERT_EQ(ended.error().code, ErrorCode::kInterrupted);
  ASSERT_TRUE(fs::exists(checkpoint_path(job.output)));
}

/// What is said of a run that goes on with `job`, which ends as refused before its first frame and
/// leaves the checkpoint.
std::string refusal(MappingJob job) {
  job.resume = true;
  const std::string checkpoint = content_of(checkpoint_path(job.output));
  std::size_t num_frames = 0;
  const auto refused = run_mapping(job, [&](std::size_t, std::size_t) { return ++num_frames > 0; });
  EXPECT_EQ(num_frames, 0U);
  EXPECT_EQ(content_of(checkpoint_path(job.output)), checkpoint);
  if (refused) return "none";
  EXPECT_NE(refused.error().code, ErrorCode::kIo);
  return to_string(refused.error());
}

TEST(ResumedRun, GivesTheBytesOfARunThatWasNotInterrupted) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  const auto whole = run_mapping(job);
  ASSERT_TRUE(whole) << to_string(whole.error());
  const std::string bytes = content_of(job.output);
  // The thread sanitizer has nothing to find where one thread works, and all in one interruption.
  for (const int num_threads : test::kThreadSanitized ? std::vector{3} : std::vector{1, 3}) {
    job.mapper.num_threads = num_threads;
    const std::size_t first = test::kThreadSanitized ? 3 : 1;
    for (std::size_t num_frames = first; num_frames < 4; ++num_frames) {
      fs::remove(job.output);
      job.resume = false;
      interrupt(job, num_frames);
      job.resume = true;
      std::vector<std::size_t> seen;
      const auto resumed = run_mapping(job, [&](std::size_t done, std::size_t total) {
        seen.push_back(done);
        return total == 4;
      });
      ASSERT_TRUE(resumed) << to_string(resumed.error());
      EXPECT_EQ(content_of(job.output), bytes) << num_frames;
      EXPECT_FALSE(fs::exists(checkpoint_path(job.output)));
      EXPECT_EQ(seen.front(), num_frames + 1);
      EXPECT_EQ(resumed->num_resumed, num_frames);
      EXPECT_EQ(resumed->num_frames, whole->num_frames);
      EXPECT_EQ(resumed->num_detections, 1U);
      EXPECT_EQ(resumed->num_segments, whole->num_segments);
      EXPECT_EQ(resumed->points.num_hits, whole->points.num_hits);
      EXPECT_EQ(resumed->up, whole->up);
    }
  }
}

TEST(ResumedRun, MayEndEarlyAgainAndNeedNoMoreCheckpoints) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  ASSERT_TRUE(run_mapping(job));
  const std::string bytes = content_of(job.output);
  interrupt(job, 1);
  job.resume = true;
  job.checkpoint_every = 0;
  const auto again = run_mapping(job, [](std::size_t done, std::size_t) { return done < 3; });
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().what, HasSubstr("the map up to rgb/100.010.pgm is in "));
  job.checkpoint_every = 1;
  interrupt(job, 3);
  job.checkpoint_every = 0;
  const auto last = run_mapping(job);
  ASSERT_TRUE(last) << to_string(last.error());
  EXPECT_EQ(last->num_resumed, 3U);
  EXPECT_EQ(content_of(job.output), bytes);
  EXPECT_FALSE(fs::exists(checkpoint_path(job.output)));
}

TEST(ResumedRun, SkippedFramesStaySkippedAndAreSaid) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  fs::remove(job.input / "depth/100.000.pgm");
  job.max_skipped_share = 0.3;
  const auto whole = run_mapping(job);
  ASSERT_TRUE(whole) << to_string(whole.error());
  const std::string bytes = content_of(job.output);
  interrupt(job, 2);
  job.resume = true;
  const auto resumed = run_mapping(job);
  ASSERT_TRUE(resumed) << to_string(resumed.error());
  EXPECT_EQ(content_of(job.output), bytes);
  ASSERT_EQ(resumed->skipped.size(), 1U);
  EXPECT_EQ(to_string(resumed->skipped[0]), to_string(whole->skipped[0]));
  EXPECT_EQ(resumed->num_frames, 3U);
  EXPECT_EQ(resumed->num_resumed, 1U);

  job.resume = false;
  interrupt(job, 2);
  job.resume = true;
  job.max_skipped_share = 0.3;
  fs::remove(job.input / "depth/103.000.pgm");
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().what, HasSubstr("2 of 4 frames could not be used"));
}

TEST(ResumedRun, AFrameOfBeforeIsNamedForAnOutlyingRegion) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  test::write_text(job.input / "groundtruth.txt",
                   "100.005 0 0 0 0 0 0 1\n101.005 900 0 0 0 0 0 1\n"
                   "102.005 1 0 0 0 0 0 1\n103.005 2 0 0 0 0 0 1\n");
  const auto whole = run_mapping(job);
  ASSERT_TRUE(whole) << to_string(whole.error());
  ASSERT_FALSE(whole->findings.empty());
  EXPECT_THAT(whole->findings.back().error.what, HasSubstr("of frame rgb/101.010.pgm"));
  interrupt(job, 2);
  job.resume = true;
  const auto resumed = run_mapping(job);
  ASSERT_TRUE(resumed) << to_string(resumed.error());
  ASSERT_EQ(resumed->findings.size(), whole->findings.size());
  EXPECT_EQ(to_string(resumed->findings.back().error), to_string(whole->findings.back().error));
}

TEST(ResumedRun, ARunThatAppendsGoesOnToo) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  job.dataset.max_frames = 1;
  job.checkpoint_every = 0;
  ASSERT_TRUE(run_mapping(job));
  const std::string before = content_of(job.output);
  job.dataset.max_frames.reset();
  job.dataset.first = 1;
  job.append = true;
  job.same_world = true;
  job.checkpoint_every = 1;
  ASSERT_TRUE(run_mapping(job));
  const std::string bytes = content_of(job.output);
  ASSERT_NE(bytes, before);

  test::write_text(job.output, before);
  interrupt(job, 2);
  EXPECT_EQ(content_of(job.output), before);
  job.resume = true;
  const auto resumed = run_mapping(job);
  ASSERT_TRUE(resumed) << to_string(resumed.error());
  EXPECT_EQ(content_of(job.output), bytes);
  EXPECT_FALSE(fs::exists(checkpoint_path(job.output)));
}

TEST(ResumedRun, AMapThatHasTheRunAlreadyDoesNotGetItTwice) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  job.dataset.max_frames = 1;
  ASSERT_TRUE(run_mapping(job));
  job.dataset.max_frames.reset();
  job.dataset.first = 1;
  job.append = true;
  job.same_world = true;
  interrupt(job, 2);
  const std::string checkpoint = content_of(checkpoint_path(job.output));
  job.resume = true;
  ASSERT_TRUE(run_mapping(job));
  test::write_text(checkpoint_path(job.output), checkpoint);
  job.force = true;
  EXPECT_THAT(refusal(job), HasSubstr("the map at --output has other runs"));
}

TEST(ResumedRun, WithoutACheckpointNothingGoesOn) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  job.resume = true;
  const auto absent = run_mapping(job);
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(absent.error().file, checkpoint_path(job.output).string());
  EXPECT_EQ(absent.error().field, "--resume");
  job.resume = false;
  ASSERT_TRUE(run_mapping(job));
  fs::rename(job.output, checkpoint_path(job.output));
  EXPECT_THAT(refusal(job), HasSubstr("a.hmap.checkpoint: --resume: is no checkpoint"));
}

TEST(ResumedRun, AnotherJobIsRefusedByWhatDiffers) {
  const TempDir folder;
  const MappingJob job = job_in(folder);
  interrupt(job, 2);
  const std::string file = checkpoint_path(job.output).string() + ": ";
  const auto refused = [&](const std::function<void(MappingJob&)>& change) {
    MappingJob other = job;
    change(other);
    return refusal(other);
  };
  EXPECT_EQ(refused([](MappingJob& other) { other.dataset.stride = 2; }),
            file + "stride: is 2, must be that of the run to go on with, 1");
  EXPECT_THAT(refused([](MappingJob& other) { other.dataset.detections.clear(); }),
              HasSubstr(file + "detections: is none"));
  EXPECT_THAT(refused([](MappingJob& other) { other.up_axis = "-y"; }),
              HasSubstr(file + "up: is -y"));
  EXPECT_EQ(refused([](MappingJob& other) { other.mapper.integration.max_range_m = 3.5; }),
            file + "integration.max_range_m: is 3.5, must be that of the run to go on with, 5");
  EXPECT_THAT(refused([](MappingJob& other) { other.mapper.octree.resolution_m = 0.1; }),
              HasSubstr(file + "octree.resolution_m: is 0.1"));
  EXPECT_THAT(refused([](MappingJob& other) { other.layers.min_free_share = 0.25; }),
              HasSubstr("min_free_share: is 0.25"));
  EXPECT_THAT(refused([&](MappingJob& other) {
                fs::copy(job.input, folder / "copy", fs::copy_options::recursive);
                other.input = folder / "copy";
              }),
              HasSubstr(file + "input: is copy, must be that of the run to go on with, dataset"));
}

TEST(ResumedRun, FramesThatChangedAreNamed) {
  const TempDir folder;
  const MappingJob job = job_in(folder);
  interrupt(job, 2);
  const std::string depth = content_of(job.input / "depth/100.000.pgm");
  test::write_text(job.input / "depth/100.000.pgm", test::pgm16(12345));
  EXPECT_THAT(refusal(job), HasSubstr("input: frame rgb/100.010.pgm has another stamp, camera"));
  test::write_text(job.input / "depth/100.000.pgm", depth);
  const std::string poses = content_of(job.input / "groundtruth.txt");
  std::string moved = poses;
  moved.replace(moved.find("101.005 1"), 9, "101.005 7");
  test::write_text(job.input / "groundtruth.txt", moved);
  EXPECT_THAT(refusal(job), HasSubstr("input: frame rgb/101.010.pgm has another stamp, camera"));
  test::write_text(job.input / "groundtruth.txt", poses);
  MappingJob resumed = job;
  resumed.resume = true;
  EXPECT_TRUE(run_mapping(resumed));
}

TEST(ResumedRun, ACheckpointIsAMapThatOtherRunsMayGoOnFrom) {
  const TempDir folder;
  MappingJob job = job_in(folder);
  interrupt(job, 2);
  const auto saved = load_saved_run(job);
  ASSERT_TRUE(saved) << to_string(saved.error());
  EXPECT_EQ(saved->checkpoint.num_positions, 2U);
  EXPECT_EQ(saved->checkpoint.report.num_frames, 2U);
  fs::rename(checkpoint_path(job.output), job.output);
  job.append = true;
  job.same_world = true;
  job.dataset.first = 2;
  ASSERT_TRUE(run_mapping(job));
  const auto map = load_archive(job.output);
  ASSERT_TRUE(map);
  EXPECT_EQ(map->value.checkpoint, ValueTree{}) << "a map that is done is no checkpoint";
}

}  // namespace
}  // namespace hypermap

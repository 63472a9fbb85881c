// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/mapping_job.hpp"

#include "io/codec/system_faults.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace hypermap {
namespace {

TEST(MappingJob, RefusesADeadline) {
  MappingJob job;
  job.mapper.deadline.rule = DeadlineRule::kFixed;
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "deadline.rule");
}

TEST(MappingJob, CorrectedPosesBuildTheMapAnew) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  std::string moved;
  for (int i = 0; i < test::kSyntheticFrames; ++i) {
    // 8 m further along y: whole bricks of 5 cm voxels.
    moved += std::to_string(100 + i) + ".005 " + std::to_string(i) + " 8 0 0 0 0 1\n";
  }
  test::write_text(folder.path() / "closed.txt", moved);
  MappingJob job{.input = folder.path() / "recorded", .output = folder.path() / "old.hmap"};
  ASSERT_TRUE(run_mapping(job));
  job.output = folder.path() / "new.hmap";
  job.poses = folder.path() / "closed.txt";
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_frames, 4U);
  const auto old_map = load_archive(folder.path() / "old.hmap").value().value;
  const auto new_map = load_archive(folder.path() / "new.hmap").value().value;
  EXPECT_EQ(new_map.octree->num_leaves(), old_map.octree->num_leaves());
  old_map.octree->for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const VoxelKey key{leaf.key.x, static_cast<std::uint16_t>(leaf.key.y + 160), leaf.key.z};
    const auto there = new_map.octree->stored_at(key);
    ASSERT_TRUE(there);
    EXPECT_EQ(there->log_odds, leaf.log_odds);
  });
}

TEST(MappingJob, StrictlyAFindingBeforeTheFirstFrameEndsTheRun) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  MappingJob job{.input = folder.path() / "recorded", .output = folder.path() / "map.hmap"};
  job.mapper.objects.transient_class_names = {"unicorn"};
  job.strict = true;
  std::size_t num_frames = 0;
  const auto refused = run_mapping(job, [&](std::size_t, std::size_t) { return ++num_frames > 0; });
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.error()).find("unicorn"), std::string::npos);
  EXPECT_EQ(num_frames, 0U);
  EXPECT_FALSE(std::filesystem::exists(job.output));
  job.strict = false;
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->findings.size(), 1U);
}

TEST(MappingJob, PeopleAreLeftOutUnlessTheyAreWanted) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  std::string found = test::chair_in("rgb/102.010.pgm");
  found.replace(found.find("chair"), 5, "human");
  test::write_text(folder.path() / "found.jsonl", found);
  MappingJob job{.input = folder.path() / "recorded", .output = folder.path() / "map.hmap"};
  ASSERT_EQ(job.mapper.objects.transient_class_names, std::vector<std::string>{"person"});
  job.dataset.detections = {folder.path() / "found.jsonl"};
  const auto num_filtered = [&] {
    const auto report = run_mapping(job);
    EXPECT_TRUE(report) << to_string(report.error());
    EXPECT_TRUE(report->findings.empty());
    return report->num_filtered;
  };
  EXPECT_EQ(num_filtered(), 0U) << "nobody is a person, and nothing is said of it";
  EXPECT_FALSE(load_archive(job.output).value().value.classes.find("person"));
  job.vocabulary =
      ClassVocabulary::create({.aliases = {{{"person"}, {{"human"}}}}, .super_classes = {}})
          .value();
  EXPECT_EQ(num_filtered(), 1U);
  job.mapper.wanted_class_names = {"human"};
  EXPECT_EQ(num_filtered(), 0U);
  job.mapper.wanted_class_names = {};
  job.mapper.objects.transient_class_names = {};
  EXPECT_EQ(num_filtered(), 0U);
}

TEST(MappingJob, DetectionsOfClassesThatAreNotWantedAreCountedAndUpdateNoObject) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  test::write_text(folder.path() / "found.jsonl", test::chair_in("rgb/102.010.pgm"));
  MappingJob job{.input = folder.path() / "recorded", .output = folder.path() / "map.hmap"};
  job.dataset.detections = {folder.path() / "found.jsonl"};
  job.mapper.wanted_class_names = {"CHAIR"};
  const auto with_chair = run_mapping(job);
  ASSERT_TRUE(with_chair) << to_string(with_chair.error());
  EXPECT_EQ(with_chair->num_detections, 1U);
  EXPECT_EQ(with_chair->num_filtered, 0U);
  EXPECT_TRUE(with_chair->findings.empty());
  job.mapper.wanted_class_names = {"chairs"};
  const auto without = run_mapping(job);
  ASSERT_TRUE(without) << to_string(without.error());
  EXPECT_EQ(without->num_detections, 1U);
  EXPECT_EQ(without->num_filtered, 1U);
  EXPECT_EQ(without->num_segments, 0U);
  ASSERT_EQ(without->findings.size(), 1U);
  EXPECT_EQ(to_string(without->findings[0].error),
            "wanted_classes: no class of the input is called \"chairs\", did you mean \"chair\"?");
  EXPECT_NE(to_json(*without).find("\"detections_filtered\": 1"), std::string::npos);
}

TEST(MappingJob, WhatTransientClassesHideIsCounted) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  test::write_text(folder.path() / "found.jsonl", test::chair_in("rgb/102.010.pgm"));
  MappingJob job{.input = folder.path() / "recorded", .output = folder.path() / "map.hmap"};
  job.dataset.detections = {folder.path() / "found.jsonl"};
  const auto whole = run_mapping(job);
  ASSERT_TRUE(whole) << to_string(whole.error());
  EXPECT_EQ(whole->points.num_transient, 0U);
  job.mapper.objects.transient_class_names = {"chair"};
  job.mapper.objects.segmentation.max_range_m = 0.5;  // all of the chair's box stands behind
  const auto still = run_mapping(job);
  ASSERT_TRUE(still) << to_string(still.error());
  const std::size_t num_transient = still->points.num_transient;
  EXPECT_GT(num_transient, 0U);
  EXPECT_EQ(still->points.num_hits + num_transient, whole->points.num_hits);
  EXPECT_EQ(still->points.num_not_measured, whole->points.num_not_measured);
  EXPECT_NE(to_json(*still).find("\"transient\": " + std::to_string(num_transient)),
            std::string::npos);
}

TEST(MappingJob, CorrectedPosesAndGoingOnExcludeEachOther) {
  const auto refused = run_mapping({.output = "map.hmap", .poses = "poses.txt", .append = true});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "append");
}

TEST(MappingJob, FramesThatTheSystemRefusesToReadAreItsError) {
  const test::TempDir folder;
  test::write_tum(folder.path() / "recorded");
  bool fails = false;
  const test::SystemFaults faults(
      [&](std::string_view call, int) { return fails && call == "open" ? EMFILE : 0; });
  const auto refused =
      run_mapping({.input = folder.path() / "recorded", .output = folder.path() / "map.hmap"},
                  [&](std::size_t, std::size_t) { return fails = true; });  // after the first frame
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo) << to_string(refused.error());
  EXPECT_NE(refused.error().what.find("Too many open files"), std::string::npos);
}

TEST(MappingJob, FramesThatAreNotThereAreTheDatasetsError) {
  const test::TempDir folder;
  const auto dataset = test::write_tum(folder.path() / "recorded");
  std::filesystem::remove(dataset.folder / dataset.depth_of_1);
  const auto refused = run_mapping({.input = dataset.folder, .output = folder.path() / "map.hmap"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit) << to_string(refused.error());
}

}  // namespace
}  // namespace hypermap

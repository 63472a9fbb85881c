// SPDX-License-Identifier: BSD-3-Clause
// Maps that are gone on from with other inputs.
#include "appended_input.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace fs = std::filesystem;
using test::TempDir;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A described dataset of four frames whose description ends with `more`.
fs::path described(const fs::path& folder, const std::string& more) {
  test::write_described(folder);
  std::string text =
      "name: synthetic\n"
      "intrinsics: {width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5}\n"
      "depth: d/*_d.pgm\ndepth_scale: 100\ntrajectory: p.txt\npair_by: order\n"
      "pose_direction: world_to_camera\n";
  test::write_text(folder / "dataset.yaml", text + more);
  return folder;
}

MapArchive map_at(const fs::path& path) {
  auto archive = load_archive(path);
  EXPECT_TRUE(archive) << to_string(archive.error());
  return archive ? std::move(archive->value) : MapArchive{};
}

Eigen::Matrix4d alignment(const Provenance& run) {
  return run.map_from_input.isometry().matrix();
}

/// A map of "first" in `folder`, and the job that appends "second" to it. The second input's own
/// description has another axis up, and frames of its own.
MappingJob job_to_append(const TempDir& folder,
                         const std::string& first_world,
                         const std::string& second_world) {
  const fs::path first = described(folder / "first", "up_axis: -y\n" + first_world);
  const fs::path second = described(folder / "second", "up_axis: z\n" + second_world);
  test::write_text(second / "d/0000_d.pgm", test::pgm16(150));
  MappingJob job{.input = first, .output = folder / "a.hmap"};
  job.mapper.num_threads = 1;
  EXPECT_TRUE(run_mapping(job));
  job.input = second;
  job.append = true;
  return job;
}

TEST(AppendedMapping, AWorldThatNothingNamesHasToBeSaid) {
  const TempDir folder;
  const MappingJob job = job_to_append(folder, "", "");
  const MapArchive before = map_at(job.output);
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("--same-world"));
  EXPECT_THAT(to_string(refused.error()), HasSubstr("--transform"));
  EXPECT_EQ(map_at(job.output), before);
}

TEST(AppendedMapping, AWorldThatBothNameIsAlignedOnce) {
  const TempDir folder;
  const MappingJob job = job_to_append(folder, "world: house\n", "world: house\n");
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_THAT(report->up, HasSubstr("first (world house)"));
  const MapArchive map = map_at(job.output);
  ASSERT_THAT(map.provenance, SizeIs(2));
  EXPECT_EQ(map.provenance[0].input, "first");
  EXPECT_EQ(map.provenance[1].input, "second");
  EXPECT_EQ(map.provenance[1].world, "house");
  EXPECT_EQ(alignment(map.provenance[1]), alignment(map.provenance[0]));
  EXPECT_NE(alignment(map.provenance[0]), Eigen::Matrix4d::Identity());
}

TEST(AppendedMapping, AnotherWorldIsSharedOnlyWhenThatIsSaid) {
  const TempDir folder;
  MappingJob job = job_to_append(folder, "world: house\n", "world: garden\n");
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("no run of world \"garden\""));
  job.same_world = true;
  ASSERT_TRUE(run_mapping(job));
  const MapArchive map = map_at(job.output);
  EXPECT_EQ(alignment(map.provenance.at(1)), alignment(map.provenance.at(0)));
}

TEST(AppendedMapping, ASharedWorldIsTheNewestOfThatInput) {
  const TempDir folder;
  MappingJob job = job_to_append(folder, "", "");
  job.placement = WorldPlacement{.x_m = 3.0};
  ASSERT_TRUE(run_mapping(job));
  job.placement.reset();
  job.same_world = true;
  job.force = true;
  job.input = folder / "first";
  ASSERT_TRUE(run_mapping(job));
  const MapArchive map = map_at(job.output);
  ASSERT_THAT(map.provenance, SizeIs(3));
  EXPECT_EQ(alignment(map.provenance[2]), alignment(map.provenance[0]));
}

TEST(AppendedMapping, APlacementStandsOnTheInputsOwnUpAxis) {
  const TempDir folder;
  MappingJob job = job_to_append(folder, "", "");
  job.placement =
      WorldPlacement{.x_m = 1.0, .y_m = 2.0, .z_m = 0.5, .yaw_rad = std::numbers::pi / 2.0};
  ASSERT_TRUE(run_mapping(job));
  const MapFromInput there = map_at(job.output).provenance.at(1).map_from_input;
  // z of the input is up: its point (1, 0, 0) lies 1 m along y from where its origin is placed.
  const Eigen::Vector3d point = there.isometry() * Eigen::Vector3d::UnitX();
  EXPECT_LT((point - Eigen::Vector3d(1.0, 3.0, 0.5)).norm(), 1e-12);
}

TEST(AppendedMapping, WhatContradictsTheMapsAlignmentIsRefused) {
  const TempDir folder;
  MappingJob job = job_to_append(folder, "world: house\n", "world: house\n");
  job.up_axis = "z";
  const auto other_axis = run_mapping(job);
  ASSERT_FALSE(other_axis);
  EXPECT_EQ(other_axis.error().field, "--up");
  job.same_world = true;
  job.placement = WorldPlacement{};
  EXPECT_FALSE(run_mapping(job));
}

TEST(AppendedMapping, AMapThatTellsNoAlignmentNeedsAPlacement) {
  const TempDir folder;
  MappingJob job = job_to_append(folder, "", "");
  MapArchive map = map_at(job.output);
  map.provenance.clear();
  ASSERT_TRUE(save_archive(map, job.output));
  job.same_world = true;
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("--transform"));
  job.same_world = false;
  job.placement = WorldPlacement{};
  ASSERT_TRUE(run_mapping(job));
  EXPECT_THAT(map_at(job.output).provenance, SizeIs(1));
}

TEST(AppendedMapping, FramesThatAreInTheMapAreRefusedBeforeTheWork) {
  const TempDir folder;
  MappingJob job = job_to_append(folder, "world: house\n", "world: house\n");
  job.input = folder / "first";
  job.dataset.stride = 2;  // other frames, the first of them the same
  const MapArchive before = map_at(job.output);
  std::size_t num_frames = 0;
  const auto refused = run_mapping(job, [&](std::size_t, std::size_t) { return ++num_frames > 0; });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("in the map already, by the run of first"));
  EXPECT_THAT(to_string(refused.error()), HasSubstr("--force"));
  EXPECT_EQ(num_frames, 0U);
  EXPECT_EQ(map_at(job.output), before);
  job.force = true;
  EXPECT_TRUE(run_mapping(job));
}

TEST(AppendedMapping, FramesOfARunThatTellsNoFirstOneAreRefusedByTheirHash) {
  const TempDir folder;
  MappingJob job = job_to_append(folder, "world: house\n", "world: house\n");
  job.input = folder / "first";
  MapArchive before = map_at(job.output);
  before.provenance.at(0).first_frame_hash.clear();
  ASSERT_TRUE(save_archive(before, job.output));
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("the same frames are in the map already"));
  EXPECT_EQ(map_at(job.output), before);
  job.force = true;
  EXPECT_TRUE(run_mapping(job));
}

TEST(AppendedMapping, FramesCountOn) {
  const TempDir folder;
  const MappingJob job = job_to_append(folder, "world: house\n", "world: house\n");
  EXPECT_EQ(map_at(job.output).provenance.at(0).next_frame_index, 4U);
  ASSERT_TRUE(run_mapping(job));
  EXPECT_EQ(map_at(job.output).provenance.at(1).next_frame_index, 8U);
}

Provenance run_up_to(std::uint64_t next_frame_index) {
  Provenance run;
  run.next_frame_index = next_frame_index;
  return run;
}

Provenance run_of(const std::string& input) {
  Provenance run;
  run.input = input;
  return run;
}

TEST(AppendedMapping, IndicesFollowWhatRunsAndObjectsTell) {
  MapArchive map;
  EXPECT_EQ(index_offset(map, 7).value(), 0U);
  Object object;
  ObservationLogEntry entry;
  entry.frame_index = 41;
  object.observation_log.add(entry);
  map.objects.add(object);
  EXPECT_EQ(index_offset(map, 0).value(), 42U);
  EXPECT_EQ(index_offset(map, 40).value(), 2U);
  EXPECT_EQ(index_offset(map, 42).value(), 0U) << "a recording that goes on keeps its indices";
  map.provenance.push_back(run_up_to(100));
  map.provenance.push_back(run_up_to(90));
  EXPECT_EQ(index_offset(map, 0).value(), 100U);
  map.provenance.push_back(run_up_to(std::uint64_t{1} << 62U));
  const auto refused = index_offset(map, 0);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
}

TEST(AppendedMapping, TheOldestRunButOneIsForgotten) {
  std::vector<Provenance> runs;
  for (std::size_t i = 0; i < kMaxRuns; ++i) add_run(runs, run_of(std::to_string(i)));
  ASSERT_THAT(runs, SizeIs(kMaxRuns));
  EXPECT_THAT(to_string(forgotten_run(runs).error), HasSubstr("that of 1 is forgotten"));
  add_run(runs, run_of("new"));
  ASSERT_THAT(runs, SizeIs(kMaxRuns));
  EXPECT_EQ(runs[0].input, "0");
  EXPECT_EQ(runs[1].input, "2");
  EXPECT_EQ(runs.back().input, "new");
}

/// A camera at the origin that looks along x at a wall; four frames from `first_stamp_s` on.
fs::path wall(const fs::path& folder, double distance_m, int first_stamp_s) {
  constexpr int kWidth = 160;
  constexpr int kHeight = 120;
  std::string depth;
  std::string poses;
  for (int i = first_stamp_s; i < first_stamp_s + 4; ++i) {
    const std::string stamp = std::to_string(i);
    const auto value = static_cast<std::uint16_t>(5000.0 * distance_m);
    test::write_text(folder / ("depth/" + stamp + ".pgm"), test::pgm16(value, kWidth, kHeight));
    depth.append(stamp).append(" depth/").append(stamp).append(".pgm\n");
    poses.append(stamp).append(" 0 0 1 -0.5 0.5 -0.5 0.5\n");
  }
  test::write_text(folder / "depth.txt", depth);
  test::write_text(folder / "groundtruth.txt", poses);
  test::write_text(folder / "intrinsics.json",
                   "{\"width\": 160, \"height\": 120, \"fx\": 140, \"fy\": 140, \"cx\": 79.5, "
                   "\"cy\": 59.5, \"depth_scale\": 5000}");
  return folder;
}

/// What is said when a wall `distance_m` away is appended, placed `x_m` further, to the map of one
/// 2 m away.
std::vector<Finding> findings_of_wall(double distance_m, double x_m) {
  const TempDir folder;
  MappingJob job{.input = wall(folder / "first", 2.0, 10), .output = folder / "a.hmap"};
  job.mapper.num_threads = 1;
  EXPECT_TRUE(run_mapping(job));
  job.input = wall(folder / "second", distance_m, 20);
  job.append = true;
  job.placement = WorldPlacement{.x_m = x_m};
  const auto report = run_mapping(job);
  EXPECT_TRUE(report) << to_string(report.error());
  return report ? report->findings : std::vector<Finding>{};
}

TEST(AppendedMapping, ThePlaceOfTheMapIsKnownAgain) {
  EXPECT_THAT(findings_of_wall(2.0, 0.0), IsEmpty());
  EXPECT_THAT(findings_of_wall(1.5, 0.5), IsEmpty()) << "the same wall from half a metre nearer";
}

TEST(AppendedMapping, AnotherPlaceIsAFinding) {
  const auto findings = findings_of_wall(1.0, 0.0);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(to_string(findings[0].error), HasSubstr("another place"));
}

TEST(AppendedMapping, WhatShowsNothingOfTheMapIsAFinding) {
  const auto findings = findings_of_wall(2.0, 30.0);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(to_string(findings[0].error), HasSubstr("shows nothing of what the map knows"));
}

}  // namespace
}  // namespace hypermap

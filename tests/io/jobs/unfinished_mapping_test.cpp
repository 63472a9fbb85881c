// SPDX-License-Identifier: BSD-3-Clause
// What is left of runs that do not end as they should.
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
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

/// Four frames in `dataset`; the output is alone in a folder of its own.
MappingJob small_job(const TempDir& folder) {
  test::write_tum(folder / "dataset");
  fs::create_directories(folder / "out");
  MappingJob job{.input = folder / "dataset", .output = folder / "out" / "a.hmap"};
  job.mapper.num_threads = 1;
  return job;
}

MapArchive saved_map(const fs::path& path) {
  auto archive = load_archive(path);
  EXPECT_TRUE(archive) << to_string(archive.error());
  return archive ? std::move(archive->value) : MapArchive{};
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// Gives frame `index` another pose.
void move_frame(const fs::path& dataset, int index, const std::string& position) {
  std::string poses;
  for (int i = 0; i < test::kSyntheticFrames; ++i) {
    poses += std::to_string(100 + i) + ".005 " +
             (i == index ? position : std::to_string(i) + " 0 0") + " 0 0 0 1\n";
  }
  test::write_text(dataset / "groundtruth.txt", poses);
}

TEST(UnfinishedMapping, AnOutlyingPoseIsNamedAndItsVoxelsStayInTheOctree) {
  for (const std::string& position : {std::string("1000 1000 0"), std::string("780 780 0")}) {
    const TempDir folder;
    const MappingJob job = small_job(folder);
    move_frame(job.input, 2, position);
    const auto report = run_mapping(job);
    ASSERT_TRUE(report) << to_string(report.error());
    EXPECT_EQ(report->num_frames, 4U);
    const auto of_layers = std::find_if(report->findings.begin(),
                                        report->findings.end(),
                                        [](const Finding& f) { return f.error.field == "layers"; });
    ASSERT_NE(of_layers, report->findings.end());
    const std::string said = to_string(of_layers->error);
    EXPECT_THAT(said, HasSubstr(job.output.string()));
    EXPECT_THAT(said, HasSubstr("leave out "));
    EXPECT_THAT(said, HasSubstr("of frame rgb/102.010.pgm"));
    const MapArchive map = saved_map(job.output);
    const LeafCount all = map.octree->num_leaves();
    EXPECT_THAT(said, ::testing::Not(HasSubstr(std::to_string(all.occupied + all.free) + " vox")));
    std::size_t num_far = 0;
    leaf_source (*map.octree)(
        [&](const LeafSample& leaf) { num_far += leaf.centre_in_map.x() > 500.0 ? 1U : 0U; });
    EXPECT_THAT(said, HasSubstr("leave out " + std::to_string(num_far) + " voxels"));
    const auto* grid = map.hypermap.find_as<OccupancyLayer>("occupancy");
    ASSERT_NE(grid, nullptr);
    EXPECT_LT(grid->grid.geometry().num_cells(), 100'000U);
    EXPECT_GT(grid->grid.counts().occupied, 0U);
  }
}

TEST(UnfinishedMapping, LimitsHoldForWhatIsSavedAndForWhatIsGoneOnFrom) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  job.limits.sums.max_pixels = 1;
  const auto unsaved = run_mapping(job);
  ASSERT_FALSE(unsaved);
  EXPECT_EQ(unsaved.error().code, ErrorCode::kLimit);
  EXPECT_THAT(unsaved.error().what, HasSubstr("(max_pixels)"));
  EXPECT_THAT(names_in(job.output.parent_path()), ::testing::ElementsAre("a.hmap.rescue"));

  job.limits = {};
  ASSERT_TRUE(run_mapping(job));
  job.append = true;
  job.stop = [] { return true; };
  EXPECT_EQ(run_mapping(job).error().code, ErrorCode::kInterrupted);
  job.stop = {};
  job.limits.sums.max_pixels = 1;
  const auto unread = run_mapping(job);
  ASSERT_FALSE(unread);
  EXPECT_EQ(unread.error().file, job.output.string());
  EXPECT_EQ(unread.error().code, ErrorCode::kLimit);
}

TEST(UnfinishedMapping, ManyOutlyingPosesAreNamedBriefly) {
  const TempDir folder;
  const MappingJob job = small_job(folder);
  test::write_text(job.input / "groundtruth.txt",
                   "100.005 0 0 0 0 0 0 1\n101.005 0 0 0 0 0 0 1\n"
                   "102.005 900 0 0 0 0 0 1\n103.005 900 0.5 0 0 0 0 1\n");
  const auto report = run_mapping(job);
  ASSERT_TRUE(report) << to_string(report.error());
  const Error& said = report->findings.back().error;
  EXPECT_EQ(said.field, "layers");
  EXPECT_THAT(said.what, HasSubstr(" of 2 frames, the first rgb/10"));
}

TEST(UnfinishedMapping, OptionsOfLayersAreRefusedBeforeTheFirstFrame) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  job.layers.min_free_share = 0.0;
  std::size_t num_frames = 0;
  const auto refused = run_mapping(job, [&](std::size_t, std::size_t) { return ++num_frames > 0; });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().field, "min_free_share");
  EXPECT_EQ(num_frames, 0U);
}

TEST(UnfinishedMapping, TooManyLostFramesEndTheRunAsSoonAsTheyAreLost) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  fs::remove(job.input / "depth/101.000.pgm");
  std::size_t num_frames = 0;
  const auto refused = run_mapping(job, [&](std::size_t, std::size_t) { return ++num_frames > 0; });
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_THAT(refused.error().what, HasSubstr("1 of 4 frames"));
  EXPECT_THAT(refused.error().what, HasSubstr("101.000.pgm"));
  EXPECT_EQ(num_frames, 1U);
  EXPECT_THAT(names_in(folder / "out"), IsEmpty());
  job.max_skipped_share = 0.25;
  EXPECT_TRUE(run_mapping(job));
}

TEST(UnfinishedMapping, FramesThatTheSystemDoesNotGiveAreItsFault) {
  const TempDir folder;
  const MappingJob job = small_job(folder);
  fs::remove(job.input / "depth/102.000.pgm");
  fs::create_symlink("102.000.pgm", job.input / "depth/102.000.pgm");  // cannot be looked at
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
  EXPECT_THAT(refused.error().what, HasSubstr("1 of 4 frames"));
  EXPECT_THAT(refused.error().what, HasSubstr("102.000.pgm"));
  EXPECT_THAT(refused.error().what, HasSubstr("errno"));
}

TEST(UnfinishedMapping, GoesOnFromACheckpointToTheSameMap) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  job.checkpoint_every = 2;
  const auto interrupted = run_mapping(job, [](std::size_t done, std::size_t) { return done < 3; });
  ASSERT_FALSE(interrupted);
  EXPECT_EQ(interrupted.error().code, ErrorCode::kInterrupted);
  EXPECT_THAT(interrupted.error().what, HasSubstr("the map up to rgb/101.010.pgm is in "));
  EXPECT_THAT(interrupted.error().what, HasSubstr(checkpoint_path(job.output).string()));
  ASSERT_THAT(names_in(folder / "out"), ::testing::ElementsAre("a.hmap.checkpoint"));
  fs::rename(checkpoint_path(job.output), job.output);
  job.append = true;
  job.same_world = true;
  job.dataset.first = 2;
  ASSERT_TRUE(run_mapping(job));
  const MapArchive gone_on = saved_map(job.output);
  job.append = false;
  job.dataset.first = 0;
  ASSERT_TRUE(run_mapping(job));
  const MapArchive whole = saved_map(job.output);
  EXPECT_EQ(gone_on.octree, whole.octree);
  EXPECT_EQ(gone_on.objects, whole.objects);
  EXPECT_EQ(gone_on.hypermap, whole.hypermap);
  EXPECT_EQ(gone_on.classes, whole.classes);
}

TEST(UnfinishedMapping, ASavedMapSupersedesItsCheckpoints) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  ASSERT_TRUE(run_mapping(job));
  const std::string bytes = bytes_of(job.output);
  job.checkpoint_every = 1;
  std::vector<bool> is_there;
  ASSERT_TRUE(run_mapping(job, [&](std::size_t, std::size_t) {
    is_there.push_back(fs::exists(checkpoint_path(job.output)));
    return true;
  }));
  EXPECT_THAT(is_there, ::testing::Each(true));
  EXPECT_THAT(names_in(folder / "out"), ::testing::ElementsAre("a.hmap"));
  EXPECT_EQ(bytes_of(job.output), bytes);
}

TEST(UnfinishedMapping, ACheckpointThatCannotBeSavedIsSaidOnceAndCostsNoFrame) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  job.checkpoint_every = 1;
  const auto report = run_mapping(job, [&](std::size_t done, std::size_t) {
    if (done == 1) {
      fs::remove(checkpoint_path(job.output));
      fs::create_directory(checkpoint_path(job.output));
    }
    return true;
  });
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_frames, 4U);
  ASSERT_THAT(report->findings, SizeIs(1));
  EXPECT_THAT(
      to_string(report->findings[0].error),
      HasSubstr("a.hmap.checkpoint: no checkpoint after rgb/101.010.pgm: is not a regular"));
  EXPECT_TRUE(saved_map(job.output).octree);
}

TEST(UnfinishedMapping, APlaceForCheckpointsIsCheckedBeforeTheFirstFrame) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  job.checkpoint_every = 1;
  fs::create_directory(checkpoint_path(job.output));
  const auto refused = run_mapping(job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kIo);
  EXPECT_EQ(refused.error().file, checkpoint_path(job.output).string());
}

TEST(UnfinishedMapping, AMapThatCannotBeSavedIsRescued) {
  const TempDir folder;
  MappingJob job = small_job(folder);
  ASSERT_TRUE(run_mapping(job));
  const MapArchive whole = saved_map(job.output);
  const auto failed = run_mapping(job, [&](std::size_t done, std::size_t total) {
    if (done < total) return true;
    fs::remove(job.output);
    return fs::create_directory(job.output);
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kIo);
  EXPECT_THAT(failed.error().what, HasSubstr("; the map is saved in "));
  EXPECT_THAT(failed.error().what, HasSubstr(rescue_path(job.output).string()));
  EXPECT_EQ(saved_map(rescue_path(job.output)), whole);
}

}  // namespace
}  // namespace hypermap

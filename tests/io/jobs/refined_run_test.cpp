// SPDX-License-Identifier: BSD-3-Clause
// Refinement of given poses in a whole job.
#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/io/jobs/mapping_job.hpp"
#include "support/box_scene.hpp"
#include "support/camera_pose.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Its depth as a 16-bit image in millimetres, 0 where nothing was measured.
std::string pgm_of(const RgbdFrame& frame) {
  std::string image = test::pgm16(0, frame.depth_m.width_px(), frame.depth_m.height_px());
  std::size_t at = image.size() - 2 * frame.depth_m.size();
  for (const float depth_m : frame.depth_m.pixels()) {
    const auto depth_mm =
        is_measured(depth_m) ? static_cast<unsigned>(std::lround(1000.0F * depth_m)) : 0U;
    image[at++] = static_cast<char>(depth_mm >> 8U);
    image[at++] = static_cast<char>(depth_mm & 0xFFU);
  }
  return image;
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

/// Ten frames in passing of a corner of a room, every second given pose 1 cm off along x. Frame 3
/// has no depth file.
MappingJob room_job(const test::TempDir& folder) {
  test::BoxScene scene(test::quarter_kinect_camera());
  scene.add(1, {-2, -3, -0.1}, {4, 3, 0}).add(2, {4, -3, 0}, {4.1, 3, 2.5});
  scene.add(3, {-2, 3, 0}, {4, 3.1, 2.5}).add(4, {3.4, 1.5, 0}, {4, 3, 1.2});
  std::string depth;
  std::string poses;
  for (int i = 0; i < 10; ++i) {
    const RgbdFrame frame = scene.view(test::camera_at({0.05 * i, 0, 1.4}, 0.3, -0.35)).frame;
    const Eigen::Isometry3d& pose = frame.map_from_camera.isometry();
    const Eigen::Quaterniond turn(pose.linear());
    const std::string stamp = std::to_string(100 + i);
    std::ostringstream line;
    line << stamp << ' ' << pose.translation().x() + (i % 2 == 0 ? 0.0 : 0.01) << ' '
         << pose.translation().y() << ' ' << pose.translation().z() << ' ' << turn.x() << ' '
         << turn.y() << ' ' << turn.z() << ' ' << turn.w() << '\n';
    poses += line.str();
    depth.append(stamp).append(" depth/").append(stamp).append(".pgm\n");
    if (i != 3) test::write_text(folder / ("dataset/depth/" + stamp + ".pgm"), pgm_of(frame));
  }
  const PinholeCamera camera = test::quarter_kinect_camera();
  std::ostringstream description;
  description << "intrinsics: {width: " << camera.width_px << ", height: " << camera.height_px
              << ", fx: " << camera.fx_px << ", fy: " << camera.fy_px << ", cx: " << camera.cx_px
              << ", cy: " << camera.cy_px
              << "}\ndepth: depth.txt\ndepth_scale: 1000\ntrajectory: groundtruth.txt\n";
  test::write_text(folder / "dataset/dataset.yaml", description.str());
  test::write_text(folder / "dataset/depth.txt", depth);
  test::write_text(folder / "dataset/groundtruth.txt", poses);
  MappingJob job{.input = folder / "dataset", .output = folder / "a.hmap"};
  job.up_axis = "z";
  job.max_skipped_share = 0.2;
  job.mapper.num_threads = 1;
  job.mapper.refinement = {.rule = PoseRefinementRule::kPointToPlane, .lag_frames = 2};
  return job;
}

TEST(RefinedRun, ResumedItPosesFramesAsOneThatWasNotInterrupted) {
  const test::TempDir folder;
  MappingJob job = room_job(folder);
  job.checkpoint_every = 1;
  const auto whole = run_mapping(job);
  ASSERT_TRUE(whole) << to_string(whole.error());
  EXPECT_EQ(whole->poses.num_refined, 9U);
  EXPECT_GT(whole->poses.max_translation_m, 0.003);
  const std::string uninterrupted = content_of(job.output);
  for (const int num_threads : {1, 2}) {
    ASSERT_FALSE(run_mapping(job, [](std::size_t done, std::size_t) { return done < 6; }));
    job.resume = true;
    job.mapper.num_threads = num_threads;
    const auto resumed = run_mapping(job);
    ASSERT_TRUE(resumed) << to_string(resumed.error());
    EXPECT_EQ(resumed->num_resumed, 5U) << "six, of which one cannot be read";
    EXPECT_EQ(resumed->poses.num_refined, 9U);
    EXPECT_EQ(content_of(job.output), uninterrupted);
    job.resume = false;
  }
}

TEST(RefinedRun, AFrameOfTheMapThatIsGoneEndsAResumedRunByName) {
  const test::TempDir folder;
  MappingJob job = room_job(folder);
  job.checkpoint_every = 1;
  ASSERT_FALSE(run_mapping(job, [](std::size_t done, std::size_t) { return done < 6; }));
  std::filesystem::remove(job.input / "depth" / "101.pgm");
  job.resume = true;
  const auto resumed = run_mapping(job);
  ASSERT_FALSE(resumed);
  EXPECT_THAT(to_string(resumed.error()), HasSubstr("101.pgm"));
}

}  // namespace
}  // namespace hypermap

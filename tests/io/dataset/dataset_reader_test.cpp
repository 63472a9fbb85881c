// SPDX-License-Identifier: BSD-3-Clause
// One contract for every layout: four frames, depth (i + 1) m, pose i m along x, a chair in
// frame 2.
#include "hypermap/io/dataset/dataset_reader.hpp"

#include "io/dataset/opened_dataset.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

using test::opened;
using test::SyntheticDataset;
using test::TempDir;
using test::write_text;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

using Writer = SyntheticDataset (*)(const std::filesystem::path&);

std::string read_error(const DatasetReader& reader, std::size_t index) {
  const auto frame = reader.read(index);
  return frame ? "was read" : to_string(frame.error());
}

class EveryLayout : public ::testing::TestWithParam<Writer> {
 protected:
  EveryLayout() : dataset_(GetParam()(dir_ / "data")) {}
  TempDir dir_;
  SyntheticDataset dataset_;
  ClassRegistry registry_;
};

TEST_P(EveryLayout, FramesComeInOrderWithDepthPoseColourAndDetections) {
  const auto reader = opened(dataset_.folder, registry_);
  ASSERT_NE(reader, nullptr);
  ASSERT_EQ(reader->size(), 4U);
  EXPECT_EQ(reader->camera(), (PinholeCamera{8, 6, 8, 8, 3.5, 2.5}));
  Stamp last{-1};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto frame = reader->read(i);
    ASSERT_TRUE(frame) << to_string(frame.error());
    EXPECT_TRUE(validate(*frame));
    EXPECT_EQ(frame->index, i);
    EXPECT_GT(frame->stamp, last);
    last = frame->stamp;
    EXPECT_EQ(frame->depth_m.at(3, 2), static_cast<float>(i + 1));
    EXPECT_EQ(frame->color.at(0, 0), (Rgb8{200, 200, 200}));
    const Eigen::Vector3d origin = frame->map_from_camera.origin().xyz;
    EXPECT_EQ(origin, Eigen::Vector3d(static_cast<double>(i), 0, 0));
    EXPECT_THAT(frame->detections, SizeIs(i == 2 ? 1U : 0U));
  }
  EXPECT_THAT(reader->summary().unpaired, SizeIs(0));
  EXPECT_TRUE(registry_.find("chair").has_value());
}

TEST_P(EveryLayout, AMissingImageConcernsOneFrame) {
  std::filesystem::remove(dataset_.folder / dataset_.depth_of_1);
  const auto reader = opened(dataset_.folder, registry_);
  ASSERT_NE(reader, nullptr);
  ASSERT_EQ(reader->size(), 4U);
  EXPECT_THAT(read_error(*reader, 1), HasSubstr("data/"));
  EXPECT_NE(read_error(*reader, 1), "was read");
  EXPECT_EQ(read_error(*reader, 2), "was read");
}

TEST_P(EveryLayout, AnUnreadableImageConcernsOneFrameAndIsNamed) {
  write_text(dataset_.folder / dataset_.depth_of_1, test::pgm16(1).substr(0, 40));
  const auto reader = opened(dataset_.folder, registry_);
  ASSERT_NE(reader, nullptr);
  EXPECT_THAT(read_error(*reader, 1), HasSubstr(dataset_.depth_of_1));
  EXPECT_EQ(read_error(*reader, 0), "was read");
}

TEST_P(EveryLayout, AnUnreadableColourImageIsNamedUnlessColourIsNotWanted) {
  write_text(dataset_.folder / dataset_.color_of_1, "no image");
  const auto reader = opened(dataset_.folder, registry_);
  ASSERT_NE(reader, nullptr);
  EXPECT_THAT(read_error(*reader, 1), HasSubstr(dataset_.color_of_1));
  ClassRegistry registry;
  const auto without = opened(dataset_.folder, registry, {.read_color = false});
  EXPECT_EQ(read_error(*without, 1), "was read");
}

TEST_P(EveryLayout, AWrongSizeInTheMiddleConcernsOneFrame) {
  write_text(dataset_.folder / dataset_.depth_of_1, test::pgm16(1000, 4, 3));
  const auto reader = opened(dataset_.folder, registry_);
  ASSERT_NE(reader, nullptr);
  EXPECT_THAT(read_error(*reader, 1), HasSubstr("is 4 x 3, expected the camera's 8 x 6"));
  EXPECT_EQ(read_error(*reader, 2), "was read");
}

TEST_P(EveryLayout, AnEightBitDepthImageIsRefused) {
  write_text(dataset_.folder / dataset_.depth_of_1, test::pgm8(7));
  const auto reader = opened(dataset_.folder, registry_);
  ASSERT_NE(reader, nullptr);
  EXPECT_THAT(read_error(*reader, 1), HasSubstr("expected depth: one channel of 16 bit"));
}

TEST_P(EveryLayout, StrideAndFirstChooseFramesThatKeepTheirIndex) {
  const auto reader = opened(dataset_.folder, registry_, {.first = 1, .stride = 2});
  ASSERT_NE(reader, nullptr);
  ASSERT_EQ(reader->size(), 2U);
  EXPECT_EQ(reader->read(0)->index, 1U);
  EXPECT_EQ(reader->read(1)->index, 3U);
}

TEST_P(EveryLayout, TheWorldCanBeTurned) {
  const auto reader = opened(dataset_.folder, registry_);
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.translation() = Eigen::Vector3d(0, 0, 5);
  reader->set_map_from_input(MapFromInput(turn));
  EXPECT_EQ(reader->read(1)->map_from_camera.origin().xyz, Eigen::Vector3d(1, 0, 5));
}

TEST_P(EveryLayout, DetectionsFromOutsideReplaceThoseOfTheFolder) {
  write_text(dir_ / "a.jsonl", test::chair_in(dataset_.color_of_1));
  write_text(dir_ / "b.jsonl", test::chair_in(dataset_.color_of_1) + test::chair_in("nowhere.png"));
  const auto reader =
      opened(dataset_.folder, registry_, {.detections = {dir_ / "a.jsonl", dir_ / "b.jsonl"}});
  ASSERT_NE(reader, nullptr);
  const auto frame = reader->read(1);
  ASSERT_TRUE(frame) << to_string(frame.error());
  ASSERT_THAT(frame->detections, SizeIs(2));
  EXPECT_EQ(frame->detections[1].detector, DetectorId{1});
  EXPECT_THAT(reader->read(2)->detections, SizeIs(0));
  EXPECT_THAT(reader->summary().unpaired, Contains("detections of nowhere.png: no frame"));
}

TEST_P(EveryLayout, ABoxWhollyOutsideTheImageCostsItselfAlone) {
  write_text(dir_ / "a.jsonl",
             "{\"image\": \"" + dataset_.color_of_1 +
                 "\", \"detections\": ["
                 "{\"label\": \"chair\", \"score\": 0.9, \"bbox\": [1, 1, 4, 5]}, "
                 "{\"label\": \"table\", \"score\": 0.9, \"bbox\": [8, 1, 9, 5]}]}\n");
  const auto reader = opened(dataset_.folder, registry_, {.detections = {dir_ / "a.jsonl"}});
  ASSERT_NE(reader, nullptr);
  const auto frame = reader->read(1);
  ASSERT_TRUE(frame) << to_string(frame.error());
  EXPECT_THAT(frame->detections, SizeIs(1));
  EXPECT_EQ(reader->summary().num_detections, 1U);
  ASSERT_THAT(reader->summary().findings, SizeIs(1));
  EXPECT_THAT(to_string(reader->summary().findings[0].error),
              HasSubstr("a.jsonl: bbox: 1 box(es) wholly outside the image of 8 x 6 are left out"));
}

INSTANTIATE_TEST_SUITE_P(Tum, EveryLayout, ::testing::Values(&test::write_tum));
INSTANTIATE_TEST_SUITE_P(SevenScenes, EveryLayout, ::testing::Values(&test::write_7scenes));
INSTANTIATE_TEST_SUITE_P(Open3d, EveryLayout, ::testing::Values(&test::write_open3d));
INSTANTIATE_TEST_SUITE_P(ScanNet, EveryLayout, ::testing::Values(&test::write_scannet));
INSTANTIATE_TEST_SUITE_P(Described, EveryLayout, ::testing::Values(&test::write_described));

TEST(DatasetReader, AMissingPoseIsNamedAndTheOthersStay) {
  const TempDir dir;
  const SyntheticDataset scenes = test::write_7scenes(dir / "s");
  std::filesystem::remove(scenes.folder / scenes.pose_of_1);
  write_text(scenes.folder / "frame-000002.pose.txt", "-inf 0 0 0\n");
  ClassRegistry registry;
  const auto reader = opened(scenes.folder, registry);
  EXPECT_THAT(read_error(*reader, 1), HasSubstr("no pose file"));
  EXPECT_THAT(read_error(*reader, 2), HasSubstr("frame-000002.pose.txt:1"));
  EXPECT_EQ(read_error(*reader, 3), "was read");
  EXPECT_THAT(reader->summary().unpaired, SizeIs(1));
}

TEST(DatasetReader, StampsPairWithinTheToleranceOnly) {
  const TempDir dir;
  const SyntheticDataset tum = test::write_tum(dir / "t");
  // The pose of frame 1 lies 5 ms away, its colour 10 ms.
  ClassRegistry registry;
  const auto narrow = opened(tum.folder, registry, {.stamp_tolerance_s = 0.006});
  EXPECT_TRUE(narrow->read(1));
  EXPECT_TRUE(narrow->read(1)->color.empty());
  EXPECT_THAT(narrow->summary().unpaired,
              Contains("depth/101.000.pgm: no colour image within 0.006 s"));
  ClassRegistry other;
  const auto narrower = opened(tum.folder, other, {.stamp_tolerance_s = 0.001});
  EXPECT_THAT(read_error(*narrower, 1), HasSubstr("no pose within 0.001 s of 101.0"));
}

TEST(DatasetReader, OptionsOutOfTheirRangeAreNamed) {
  const auto field = [](const DatasetOptions& options) {
    ClassRegistry registry;
    return open_dataset("absent", options, registry).error().field;
  };
  EXPECT_EQ(field({.stamp_tolerance_s = -0.1}), "stamp_tolerance_s");
  EXPECT_EQ(field({.stamp_tolerance_s = 3601.0}), "stamp_tolerance_s");
  EXPECT_EQ(field({.stride = 0}), "stride");
  EXPECT_EQ(field({.max_frames = 0}), "max_frames");
}

TEST(DatasetReader, ABadTrajectoryLineCostsItsFrameAndIsAFinding) {
  const TempDir dir;
  const SyntheticDataset tum = test::write_tum(dir / "t");
  write_text(tum.folder / "groundtruth.txt",
             "100 0 0 0 0 0 0 1\n101 nan 0 0 0 0 0 1\n102 2 0 0 0 0 0 1\n103 3 0 0 0 0 0 1\n");
  ClassRegistry registry;
  const auto reader = opened(tum.folder, registry);
  EXPECT_THAT(reader->summary().findings, SizeIs(1));
  EXPECT_THAT(read_error(*reader, 1), HasSubstr("no pose"));
  EXPECT_EQ(read_error(*reader, 2), "was read");
}

/// Where a point before the camera of the first frame lies when the poses have these axes.
Eigen::Vector3d point_in_map(const std::string& camera_axes, const Eigen::Vector3d& in_camera) {
  const TempDir dir;
  const SyntheticDataset data = test::write_described(dir / "d");
  write_text(
      data.folder / "dataset.yaml",
      "intrinsics: {width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5}\n"
      "depth: d/*_d.pgm\ndepth_scale: 100\ntrajectory: p.txt\npair_by: order\ncamera_axes: " +
          camera_axes + "\n");
  ClassRegistry registry;
  const auto reader = opened(data.folder, registry);
  return (reader->read(0)->map_from_camera * PointInCamera{in_camera}).xyz;
}

TEST(DatasetReader, OpenGlAxesBecomeOptical) {
  // One metre ahead of the camera is one metre along -z of OpenGL's camera, the world here.
  EXPECT_EQ(point_in_map("opengl", {0, 0.5, 1}), Eigen::Vector3d(0, -0.5, -1));
}

TEST(DatasetReader, RobotAxesBecomeOptical) {
  // Ahead is x, right is -y, down is -z.
  EXPECT_EQ(point_in_map("robot", {0.25, 0.5, 1}), Eigen::Vector3d(1, -0.25, -0.5));
}

TEST(DatasetReader, DepthOfAnotherCameraIsRegisteredToColour) {
  const TempDir dir;
  const SyntheticDataset data = test::write_described(dir / "d");
  // The depth camera sits one metre to the left of the colour camera (x of colour = x + 1): at 2 m
  // and f = 8 every point moves by 8 * 1 / 2 = 4 pixels to the right.
  std::string half = test::pgm16(200);
  write_text(data.folder / "dataset.yaml",
             "intrinsics: {width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5}\n"
             "depth_intrinsics: {width: 8, height: 6, fx: 8, fy: 8, cx: 3.5, cy: 2.5}\n"
             "color_from_depth: [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]\n"
             "depth: d/*_d.pgm\ndepth_scale: 100\ncolor: c/*_c.pgm\n"
             "trajectory: p.txt\npair_by: order\n");
  ClassRegistry registry;
  const auto reader = opened(data.folder, registry);
  const auto frame = reader->read(1);
  ASSERT_TRUE(frame) << to_string(frame.error());
  EXPECT_EQ(frame->depth_m.at(3, 2), 0.0F);
  EXPECT_EQ(frame->depth_m.at(4, 2), 2.0F);
  EXPECT_EQ(frame->depth_m.at(7, 5), 2.0F);
}

TEST(DatasetReader, LabelImagesOfScanNetBecomeDetections) {
  const TempDir dir;
  const SyntheticDataset data = test::write_scannet(dir / "s");
  // 20 x 20 images, so that a region can have its 64 pixels: a bed (4) on the left, 10 x 20.
  const std::string matrix = "8 0 9.5\n0 8 9.5\n0 0 1\n";
  write_text(data.folder / "intrinsic/intrinsic_color.txt", matrix);
  write_text(data.folder / "intrinsic/intrinsic_depth.txt", matrix);
  std::string labels = test::pgm8(0, 20, 20);
  for (std::size_t i = 0; i < 400; ++i) labels[labels.size() - 400 + i] = i % 20 < 10 ? 4 : 0;
  for (int i = 0; i < 4; ++i) {
    const std::string name = std::to_string(i) + ".pgm";
    write_text(data.folder / "color" / name, test::pgm8(1, 20, 20));
    write_text(data.folder / "depth" / name, test::pgm16(1000, 20, 20));
    write_text(data.folder / "label" / name, labels);
  }
  std::filesystem::remove(data.folder / "detections.jsonl");
  ClassRegistry registry;
  const auto reader = opened(data.folder, registry);
  const auto frame = reader->read(0);
  ASSERT_TRUE(frame) << to_string(frame.error());
  ASSERT_THAT(frame->detections, SizeIs(1));
  EXPECT_EQ(frame->detections[0].box_px, (PixelBox{0, 0, 10, 20}));
  EXPECT_EQ(best_class(frame->detections[0].class_scores)->id, *registry.find("bed"));
  EXPECT_EQ(frame->detections[0].mask->at(9, 19), 1);
  EXPECT_EQ(frame->detections[0].mask->at(10, 19), 0);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/sensed_stack.hpp"

#include "projection/sensor_models/sensor_worlds.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace hypermap {
namespace {

constexpr int kNumFrames = 3;

/// Millimetres; what is no measurement is 0.
std::string depth_pgm(const DepthImage& depth_m) {
  std::string text = "P5\n160 120\n65535\n";
  for (const float depth : depth_m.pixels()) {
    const bool is_far = !std::isfinite(depth) || depth > 60.0F;
    const auto units = is_far ? 0U : static_cast<unsigned>(std::lround(depth * 1000.0F));
    text.push_back(static_cast<char>(units >> 8U));
    text.push_back(static_cast<char>(units & 0xFFU));
  }
  return text;
}

/// The same view of the made wall three times, a chair detected in the last one, as TUM RGB-D.
void write_wall(const std::filesystem::path& folder) {
  const RgbdFrame frame = test::frame_of_wall(test::placed(0.0, 0.0));
  const Eigen::Quaterniond turn(frame.map_from_camera.isometry().linear());
  const Eigen::Vector3d eye = frame.map_from_camera.origin().xyz;
  std::string pose;
  for (const double value : {eye.x(), eye.y(), eye.z(), turn.x(), turn.y(), turn.z(), turn.w()}) {
    pose += " " + std::to_string(value);
  }
  std::string depth;
  std::string rgb;
  std::string poses;
  for (int i = 0; i < kNumFrames; ++i) {
    const std::string second = std::to_string(100 + i);
    test::write_text(folder / ("depth/" + second + ".pgm"), depth_pgm(frame.depth_m));
    test::write_text(folder / ("rgb/" + second + ".pgm"),
                     "P5\n160 120\n255\n" + std::string(std::size_t{160} * 120, '\x40'));
    depth.append(second).append(".000 depth/").append(second).append(".pgm\n");
    rgb.append(second).append(".000 rgb/").append(second).append(".pgm\n");
    poses.append(second).append(".000").append(pose).append("\n");
  }
  test::write_text(folder / "depth.txt", depth);
  test::write_text(folder / "rgb.txt", rgb);
  test::write_text(folder / "groundtruth.txt", poses);
  test::write_text(folder / "intrinsics.json",
                   "{\"width\": 160, \"height\": 120, \"fx\": 100, \"fy\": 100, \"cx\": 79.5, "
                   "\"cy\": 59.5, \"depth_scale\": 1000}");
  const PixelPoint left = test::pixel_of(1.2, 0.2, 0.0);
  const PixelPoint right = test::pixel_of(1.2, -0.2, 0.0);
  test::write_text(
      folder / "detections.jsonl",
      "{\"image\": \"rgb/102.pgm\", \"detections\": [{\"label\": \"chair\", \"score\": "
      "1.0, \"bbox\": [" +
          std::to_string(left.u_px + 0.5) + ", 10, " + std::to_string(right.u_px + 0.5) + ", " +
          std::to_string(left.v_px + 0.5) + "]}]}\n");
}

/// 6 m x 6 m about (1, 0).
GridStack empty_stack() {
  const GridGeometry geometry{
      .resolution_m = 0.1, .origin = Eigen::Vector2d(-2.0, -3.0), .cols = 60, .rows = 60};
  return GridStack::create(geometry).value();
}

class SensedStack : public testing::Test {
 protected:
  void SetUp() override {
    write_wall(job_.input);
    Eigen::Isometry3d a_metre_on = Eigen::Isometry3d::Identity();
    a_metre_on.translation().x() = 1.0;
    runs_[0].input = "wall";
    runs_[0].map_from_input = MapFromInput(a_metre_on);
  }

  [[nodiscard]] Result<SensedStackReport> fuse() {
    return fuse_frames(stack_, job_, runs_, ClassRegistry());
  }
  [[nodiscard]] int at(const std::string& layer, double x_m, double y_m) const {
    const LogOddsGrid& grid = stack_.layers().at(layer);
    return grid.at(cell_at(grid.geometry(), {x_m, y_m}).value());
  }

  test::TempDir folder_;
  SensedStackJob job_{.input = folder_.path() / "wall"};
  std::vector<Provenance> runs_ = std::vector<Provenance>(1);
  GridStack stack_ = empty_stack();
};

TEST_F(SensedStack, FramesAreFusedWhereTheMapHasTheirWorld) {
  const auto report = fuse();
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_frames, 3U);
  EXPECT_TRUE(report->skipped.empty());
  ASSERT_EQ(stack_.layers().size(), 1U);
  EXPECT_EQ(at("/ism/depth", 2.25, 0.05), 3 * test::kFree);
  EXPECT_EQ(at("/ism/depth", 1.0 + test::kWallFrontM + 0.01, 0.05), 3 * test::kHit);
  EXPECT_EQ(at("/ism/depth", 3.35, 0.05), 0);
}

TEST_F(SensedStack, WeightsAreThoseOfTheSensors) {
  job_.sensors = {{.kind = FrameSensorKind::kDepth, .weight = 0.5}};
  ASSERT_TRUE(fuse());
  EXPECT_NEAR(at("/ism/depth", 2.25, 0.05), 1.5 * test::kFree, 2.0);
}

TEST_F(SensedStack, ClassesThatWereDetectedGetALayer) {
  job_.sensors = {{.kind = FrameSensorKind::kDetections}};
  ClassRegistry known;
  ASSERT_TRUE(known.add("table"));
  const auto report = fuse_frames(stack_, job_, runs_, known);
  ASSERT_TRUE(report) << to_string(report.error());
  ASSERT_EQ(stack_.layers().size(), 1U);
  // Twice the ground was seen there, and once the chair: 1386 for p = 0.8.
  EXPECT_NEAR(at("/ism/detections/chair", 2.35, 0.05), 1386 + 2 * test::kFree, 2);
  EXPECT_EQ(at("/ism/detections/chair", 2.05, 0.05), 3 * test::kFree);
}

TEST_F(SensedStack, OnlyWantedClassesAreSensed) {
  job_.sensors = {{.kind = FrameSensorKind::kDetections}};
  job_.classes = {"table"};
  EXPECT_EQ(fuse().error().code, ErrorCode::kNotFound);
  ClassRegistry known;
  ASSERT_TRUE(known.add("table"));
  ASSERT_TRUE(fuse_frames(stack_, job_, runs_, known));
  EXPECT_TRUE(stack_.layers().empty());
}

TEST_F(SensedStack, AnInputThatTheMapKnowsNothingOfIsRefused) {
  runs_[0].input = "another";
  const auto refused = fuse();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "--input");
  EXPECT_TRUE(stack_.layers().empty());
}

TEST_F(SensedStack, FramesThatCannotBeReadAreLeftOutAndNamed) {
  test::write_text(job_.input / "depth/101.pgm", "P5\n160 120\n65535\n");
  const auto report = fuse();
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->num_frames, 2U);
  ASSERT_EQ(report->skipped.size(), 1U);
  EXPECT_NE(to_string(report->skipped.front()).find("101.pgm"), std::string::npos);
}

TEST_F(SensedStack, WithoutAFrameOrWhenInterruptedTheStackStays) {
  for (int i = 0; i < kNumFrames; ++i) {
    test::write_text(job_.input / ("depth/" + std::to_string(100 + i) + ".pgm"), "P5\n");
  }
  EXPECT_EQ(fuse().error().code, ErrorCode::kNotFound);
  EXPECT_EQ(stack_, empty_stack());
  write_wall(job_.input);
  const auto stopped =
      fuse_frames(stack_, job_, runs_, {}, [](std::size_t done, std::size_t) { return done < 2; });
  EXPECT_EQ(stopped.error().code, ErrorCode::kInterrupted);
  EXPECT_EQ(stack_, empty_stack());
}

TEST_F(SensedStack, WhenNoFrameCanBeRegisteredTheStackStays) {
  job_.reference = "/ism/map";
  EXPECT_EQ(fuse().error().field, "--register");
  const auto map = LogOddsGrid::create(stack_.geometry()).value();
  ASSERT_TRUE(stack_.fuse({.layer = "/ism/map", .grid = map},
                          Eigen::Matrix3d(Eigen::Matrix3d::Identity())));
  const GridStack before = stack_;
  const auto report = fuse();
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(report.error().field, "--register");
  EXPECT_NE(report.error().what.find("3 frames: too little structure"), std::string::npos);
  EXPECT_EQ(stack_, before);
}

TEST_F(SensedStack, NothingToBeSensedIsRefused) {
  job_.sensors.clear();
  EXPECT_EQ(fuse().error().field, "--sensor");
}

}  // namespace
}  // namespace hypermap

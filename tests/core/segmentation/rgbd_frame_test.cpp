// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

RgbdFrame small_frame() {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 4, .height_px = 3, .fx_px = 5, .fy_px = 5, .cx_px = 1.5, .cy_px = 1.0};
  frame.depth_m = DepthImage(4, 3, 1.0F);
  return frame;
}

Detection sound_detection() {
  return {.box_px = {0.0, 0.0, 2.0, 2.0},
          .class_scores = {{ClassId{0}, Probability(0.75)}, {ClassId{3}, Probability(0.25)}},
          .score = Probability(0.9),
          .detector = {},
          .mask = {}};
}

std::string field_of(const RgbdFrame& frame) {
  return validate(frame).error().field;
}

TEST(RgbdFrame, WithoutColourOrDetectionsIsFine) {
  EXPECT_TRUE(validate(small_frame()).has_value());
}

TEST(RgbdFrame, NamesTheImageWhoseSizeDisagrees) {
  RgbdFrame frame = small_frame();
  frame.depth_m = DepthImage(3, 4);
  EXPECT_EQ(field_of(frame), "depth_m");
  EXPECT_EQ(validate(frame).error().what, "must have the camera's size 4x3, is 3x4");

  frame = small_frame();
  frame.color = ColorImage(4, 2);
  EXPECT_EQ(field_of(frame), "color");

  frame = small_frame();
  frame.detections.assign(2, sound_detection());
  frame.detections[1].mask = MaskImage(2, 2);
  EXPECT_EQ(field_of(frame), "detections[1].mask");
}

TEST(RgbdFrame, RefusesAPoseThatIsNoRigidMotion) {
  RgbdFrame frame = small_frame();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() *= 1.01;
  frame.map_from_camera = MapFromCamera(pose);
  EXPECT_EQ(field_of(frame), "map_from_camera");

  pose = Eigen::Isometry3d::Identity();
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  frame.map_from_camera = MapFromCamera(pose);
  EXPECT_EQ(field_of(frame), "map_from_camera");

  pose = Eigen::Isometry3d::Identity();
  pose.linear()(2, 2) = -1.0;
  frame.map_from_camera = MapFromCamera(pose);
  EXPECT_EQ(field_of(frame), "map_from_camera");
}

TEST(RgbdFrame, RefusesAFloorThatIsNowhere) {
  RgbdFrame frame = small_frame();
  frame.floor_height_m = -1.2;
  EXPECT_TRUE(validate(frame));
  frame.floor_height_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field_of(frame), "floor_height_m");
}

TEST(RgbdFrame, RefusesAnIndexThatNoArchiveHolds) {
  RgbdFrame frame = small_frame();
  frame.index = std::uint64_t{1} << 63U;
  EXPECT_EQ(field_of(frame), "index");
  --frame.index;
  EXPECT_TRUE(validate(frame).has_value());
}

TEST(RgbdFrame, RefusesDetectionsThatBreakTheirRules) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto field_with = [](const auto& change) {
    RgbdFrame frame = small_frame();
    frame.detections.assign(2, sound_detection());
    change(frame.detections[1]);
    return validate(frame) ? std::string() : field_of(frame);
  };
  EXPECT_EQ(field_with([](Detection&) {}), "");
  EXPECT_EQ(field_with([](Detection& d) { d.box_px.u_max_px = 0.0; }), "") << "an empty box";
  EXPECT_EQ(field_with([](Detection& d) { d.box_px.u_max_px = -1.0; }), "detections[1].box_px");
  EXPECT_EQ(field_with([&](Detection& d) { d.box_px.v_min_px = nan; }), "detections[1].box_px");
  const auto scores_field = [&](std::vector<ClassEvidence> scores) {
    return field_with([&](Detection& d) { d.class_scores = scores; });
  };
  const std::string expected = "detections[1].class_scores";
  EXPECT_EQ(scores_field({}), expected);
  EXPECT_EQ(scores_field({{ClassId{0}, Probability(0.5)}}), expected) << "sum";
  EXPECT_EQ(scores_field({{ClassId{1}, Probability(0.5)}, {ClassId{1}, Probability(0.5)}}),
            expected);
  EXPECT_EQ(scores_field({{ClassId{65535}, Probability(1.0)}}), expected);
}

TEST(RgbdFrame, HandsOnTheCamerasError) {
  RgbdFrame frame = small_frame();
  frame.camera.fx_px = 0;
  EXPECT_EQ(field_of(frame), "fx_px");
}

}  // namespace
}  // namespace hypermap

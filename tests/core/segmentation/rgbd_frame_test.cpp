// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

RgbdFrame small_frame() {
  RgbdFrame frame;
  frame.camera = {
      .width_px = 4, .height_px = 3, .fx_px = 5, .fy_px = 5, .cx_px = 1.5, .cy_px = 1.0};
  frame.depth_m = DepthImage(4, 3, 1.0F);
  return frame;
}

std::string field_of(const RgbdFrame& frame) {
  return validate(frame).error().field;
}

TEST(RgbdFrame, WithoutColourOrDetectionsIsFine) {
  EXPECT_TRUE(validate(small_frame()).has_value());
}

TEST(RgbdFrame, NamesThePictureWhoseSizeDisagrees) {
  RgbdFrame frame = small_frame();
  frame.depth_m = DepthImage(3, 4);
  EXPECT_EQ(field_of(frame), "depth_m");
  EXPECT_EQ(validate(frame).error().what, "must have the camera's size 4x3, is 3x4");

  frame = small_frame();
  frame.color = ColorImage(4, 2);
  EXPECT_EQ(field_of(frame), "color");

  frame = small_frame();
  frame.detections.resize(2);
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

TEST(RgbdFrame, HandsOnTheCamerasError) {
  RgbdFrame frame = small_frame();
  frame.camera.fx_px = 0;
  EXPECT_EQ(field_of(frame), "fx_px");
}

}  // namespace
}  // namespace hypermap

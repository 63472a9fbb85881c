// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/instance_sightings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace hypermap {
namespace {

using ::testing::ElementsAre;

/// A camera at the origin looks along +z of the world at a wall 2 m away; y is down. With a focal
/// length of 100 px a metre of the wall is 50 px.
class InstanceSightingsTest : public ::testing::Test {
 protected:
  InstanceSightingsTest() {
    frame_.camera = {.width_px = 200,
                     .height_px = 100,
                     .fx_px = 100.0,
                     .fy_px = 100.0,
                     .cx_px = 99.5,
                     .cy_px = 49.5};
    frame_.depth_m = DepthImage(200, 100, 2.0F);
    listed_.up_in_input = -Eigen::Vector3d::UnitY();
  }

  void list(const std::string& name, double x, const std::vector<std::string>& classes) {
    listed_.instances.push_back({.name = name,
                                 .class_names = classes,
                                 .centre = {{x, 0.0, 2.0}},
                                 .size_m = {0.5, 0.3, 0.5}});
  }

  void detect(const std::string& name, const PixelBox& box) {
    const ClassId id = classes_.add(name).value();
    Detection detection;
    detection.box_px = box;
    detection.class_scores = {{id, Probability(1.0)}};
    detection.score = Probability(0.9);
    frame_.detections.push_back(std::move(detection));
  }

  std::vector<std::size_t> named() {
    InstanceSightings sightings(listed_);
    sightings.add(frame_, classes_);
    return sightings.frames_named();
  }

  RgbdFrame frame_;
  ListedInstances listed_;
  ClassRegistry classes_;
};

TEST_F(InstanceSightingsTest, ADetectionNamesTheInstanceOfItsClassWithMostOfItsPixels) {
  list("left", -0.5, {"chair"});
  list("right", 0.5, {"chair"});
  list("sofa", 0.5, {"sofa"});
  detect("chair", {.u_min_px = 100, .v_min_px = 30, .u_max_px = 150, .v_max_px = 70});
  EXPECT_THAT(named(), ElementsAre(0U, 1U, 0U));
}

TEST_F(InstanceSightingsTest, TwoHundredMeasuredPixelsAreAsked) {
  // The thing and its margin of 0.05 m cover 0.6 m, 30 px each way: columns 85 to 114.
  list("box", 0.0, {"chair"});
  detect("chair", {.u_min_px = 90, .v_min_px = 40, .u_max_px = 110, .v_max_px = 50});
  EXPECT_THAT(named(), ElementsAre(1U));
  frame_.depth_m.at(95, 45) = 0.0F;
  EXPECT_THAT(named(), ElementsAre(0U));
  frame_.depth_m.at(95, 45) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(named(), ElementsAre(0U));
}

TEST_F(InstanceSightingsTest, WhatHidesAInstanceIsNotIt) {
  list("box", 0.0, {"chair"});
  detect("chair", {.u_min_px = 85, .v_min_px = 35, .u_max_px = 115, .v_max_px = 65});
  frame_.depth_m = DepthImage(200, 100, 1.5F);
  EXPECT_THAT(named(), ElementsAre(0U));
}

TEST_F(InstanceSightingsTest, AFrameCountsOnceAndFramesAddUp) {
  list("box", 0.0, {"sofa", "chair"});
  const PixelBox box{.u_min_px = 85, .v_min_px = 35, .u_max_px = 115, .v_max_px = 65};
  detect("Chair", box);
  detect("couch", box);
  InstanceSightings sightings(listed_);
  sightings.add(frame_, classes_);
  sightings.add(frame_, classes_);
  EXPECT_THAT(sightings.frames_named(), ElementsAre(2U));
}

TEST_F(InstanceSightingsTest, BoxesBeyondTheImageAreCutAtItsEdge) {
  list("box", -1.9, {"chair"});
  detect("chair", {.u_min_px = -50, .v_min_px = -1e9, .u_max_px = 30, .v_max_px = 1e9});
  EXPECT_THAT(named(), ElementsAre(1U));
}

TEST_F(InstanceSightingsTest, ThePoseOfTheCameraCounts) {
  list("box", 0.0, {"chair"});
  detect("chair", {.u_min_px = 85, .v_min_px = 35, .u_max_px = 115, .v_max_px = 65});
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.translation().z() = 1.0;
  frame_.map_from_camera = MapFromCamera(moved);
  EXPECT_THAT(named(), ElementsAre(0U));
  frame_.depth_m = DepthImage(200, 100, 1.0F);
  EXPECT_THAT(named(), ElementsAre(1U));
}

}  // namespace
}  // namespace hypermap

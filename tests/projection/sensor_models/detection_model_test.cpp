// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/detection_model.hpp"

#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

constexpr double kSureHit = 1386.3;  // ln(0.8 / 0.2)

ClassRegistry cup_and_chair() {
  const std::string names[] = {"cup", "chair"};
  return ClassRegistry::from_names(names).value();
}

/// A chair whose foot runs along x = 1.2 from y = 0.2 to -0.2.
Detection chair(double score = 1.0) {
  const PixelPoint left = pixel_of(1.2, 0.2, 0.0);
  const PixelPoint right = pixel_of(1.2, -0.2, 0.0);
  Detection detection;
  detection.box_px = {left.u_px + 0.5, 10.0, right.u_px + 0.5, left.v_px + 0.5};
  detection.score = Probability(score);
  detection.class_scores = {{ClassId{0}, Probability(0.1)}, {ClassId{1}, Probability(0.9)}};
  return detection;
}

RgbdFrame frame_with(const Detection& detection) {
  RgbdFrame frame = frame_of_wall(placed(0.0, 0.0));
  frame.detections = {detection};
  return frame;
}

std::vector<SensorGrid> grids_of(const RgbdFrame& frame, DetectionModelOptions options = {}) {
  return DetectionModel::create(cup_and_chair(), std::move(options)).value().grids(frame).value();
}

int told_at(const SensorGrid& sensor, double x_m, double y_m) {
  const auto cell = cell_at(sensor.grid.geometry(), {x_m, y_m});
  return cell ? sensor.grid.at(*cell) : 0;
}

TEST(DetectionModel, AnObjectStandsWhereItsFootMeetsTheGround) {
  const auto grids = grids_of(frame_with(chair(0.5)));
  ASSERT_EQ(grids.size(), 2U);
  EXPECT_EQ(grids[1].layer, "/ism/detections/chair");
  // 0.4 m wide, as deep: from x = 1.2 to 1.6; half as sure as with score 1.
  EXPECT_NEAR(told_at(grids[1], 1.22, 0.12), 0.5 * kSureHit, 1.0);
  EXPECT_NEAR(told_at(grids[1], 1.57, -0.12), 0.5 * kSureHit, 1.0);
  EXPECT_EQ(told_at(grids[1], 1.12, 0.12), kFree);
  EXPECT_EQ(told_at(grids[1], 1.67, 0.12), kFree);
  EXPECT_EQ(told_at(grids[0], 1.22, 0.12), kFree);  // no cup, and the ground is seen
}

TEST(DetectionModel, ObjectsAreNoLongerThanAskedFor) {
  const auto grids = grids_of(frame_with(chair()), {.max_length_m = 0.1});
  EXPECT_NEAR(told_at(grids[1], 1.22, 0.12), kSureHit, 1.0);
  EXPECT_EQ(told_at(grids[1], 1.37, 0.12), kFree);
}

TEST(DetectionModel, AMasksFootIsItsLowestPart) {
  Detection detection = chair();
  // A post of the right half's width stands on the foot; the box is as wide as before.
  detection.mask = MaskImage(160, 120, 0);
  const auto& box = detection.box_px;
  const int v_end = static_cast<int>(std::lround(box.v_max_px));
  for (int v = 10; v < v_end; ++v) {
    const double u_begin = v < 20 ? box.u_min_px : (box.u_min_px + box.u_max_px) / 2.0;
    for (int u = static_cast<int>(std::lround(u_begin)); u < std::lround(box.u_max_px); ++u) {
      detection.mask->at(u, v) = 1;
    }
  }
  const auto grids = grids_of(frame_with(detection));
  EXPECT_GT(told_at(grids[1], 1.27, -0.12), 0.9 * kSureHit);
  EXPECT_EQ(told_at(grids[1], 1.27, 0.12), kFree);
}

TEST(DetectionModel, AFootThatIsCutOrHighUpOrFarSaysNothing) {
  Detection cut = chair();
  cut.box_px.v_max_px = 120.0;
  EXPECT_LT(told_at(grids_of(frame_with(cut))[1], 1.22, 0.12), 0);
  // The lower edge of what hangs on the wall 0.5 m high: its pixel's depth is that of the wall.
  Detection high = chair();
  high.box_px.v_max_px = pixel_of(kWallFrontM, 0.0, 0.5).v_px;
  const auto hanging = grids_of(frame_with(high));
  EXPECT_LE(std::ranges::max(hanging[1].grid.cells()), 0);
  const auto near = grids_of(frame_with(chair()), {.max_range_m = 1.0});
  EXPECT_LE(std::ranges::max(near[1].grid.cells()), 0);
}

TEST(DetectionModel, WithoutDepthAFootIsTakenForOne) {
  RgbdFrame frame = frame_with(chair());
  for (float& depth : frame.depth_m.pixels()) depth = 0.0F;
  const auto grids = grids_of(frame);
  EXPECT_NEAR(told_at(grids[1], 1.22, 0.12), kSureHit, 1.0);
  for (const LogOddsSteps steps : grids[1].grid.cells()) EXPECT_GE(steps, 0);
  EXPECT_EQ(grids[0].grid.num_known(), 0U);
}

TEST(DetectionModel, TheStrongerOfTwoCounts) {
  RgbdFrame frame = frame_with(chair(0.4));
  frame.detections.push_back(chair(0.9));
  frame.detections.push_back(chair(0.6));
  EXPECT_NEAR(told_at(grids_of(frame)[1], 1.22, 0.12), 0.9 * kSureHit, 1.0);
}

TEST(DetectionModel, AnUnknownClassSaysNothing) {
  Detection stranger = chair();
  stranger.class_scores = {{ClassId{7}, Probability(1.0)}};
  for (const SensorGrid& sensor : grids_of(frame_with(stranger))) {
    for (const LogOddsSteps steps : sensor.grid.cells()) EXPECT_LE(steps, 0);
  }
  EXPECT_EQ(DetectionModel::create({}).error().field, "classes");
}

}  // namespace
}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/class_image_model.hpp"

#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace hypermap::test {
namespace {

ClassRegistry three_classes() {
  const std::string names[] = {"lawn", "road", "kerb/stone"};
  return ClassRegistry::from_names(names).value();
}

/// 2 m above (0, 0), looking straight down, image rows along the map's x; a metre of the ground is
/// 50 pixels: a pixel is 2 cm.
ClassImage from_above() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation().z() = 2.0;
  pose.linear() << 1, 0, 0,  //
      0, -1, 0,              //
      0, 0, -1;
  return {
      .camera =
          {.width_px = 101, .height_px = 101, .fx_px = 100, .fy_px = 100, .cx_px = 50, .cy_px = 50},
      .map_from_camera = MapFromCamera(pose),
      .classes = Image<std::uint16_t>(101, 101, 0)};
}

int class_at(const SensorGrid& sensor, double x_m, double y_m) {
  const auto cell = cell_at(sensor.grid.geometry(), {x_m, y_m});
  return cell ? sensor.grid.at(*cell) : 0;
}

TEST(ClassImageModel, APixelSpeaksOfTheCellThatItShows) {
  ClassImage image = from_above();
  // Columns 60 to 69, rows 20 to 29: x from 0.19 to 0.39, y from 0.61 to 0.41 (rows go down).
  for (int v = 20; v < 30; ++v) {
    for (int u = 60; u < 70; ++u) image.classes.at(u, v) = 1;
  }
  const auto grids = ClassImageModel::create(three_classes()).value().grids(image).value();
  ASSERT_EQ(grids.size(), 3U);
  EXPECT_EQ(grids[0].layer, "/ism/classes/lawn");
  EXPECT_EQ(grids[2].layer, "/ism/classes/kerb_stone");
  EXPECT_EQ(class_at(grids[1], 0.31, 0.51), 847);   // ln(0.7 / 0.3)
  EXPECT_EQ(class_at(grids[0], 0.31, 0.51), -405);  // ln(0.4 / 0.6)
  EXPECT_EQ(class_at(grids[2], 0.31, 0.51), -405);
  EXPECT_EQ(class_at(grids[0], -0.31, 0.51), 847);
  EXPECT_EQ(class_at(grids[1], 0.31, -0.51), -405);
  EXPECT_EQ(class_at(grids[0], 1.21, 0.0), 0);  // out of view
}

TEST(ClassImageModel, WhatHasNoClassOrAStrangeOneSaysNothing) {
  ClassImage image = from_above();
  for (int v = 0; v < 101; ++v) {
    for (int u = 0; u < 50; ++u) image.classes.at(u, v) = v < 50 ? ClassImage::kNoClass : 3;
  }
  const auto grids = ClassImageModel::create(three_classes()).value().grids(image).value();
  for (const SensorGrid& sensor : grids) {
    EXPECT_EQ(class_at(sensor, -0.51, 0.51), 0);
    EXPECT_EQ(class_at(sensor, -0.51, -0.51), 0);
    EXPECT_NE(class_at(sensor, 0.51, 0.51), 0);
  }
}

TEST(ClassImageModel, TheGroundsHeightScalesThePicture) {
  ClassImage image = from_above();
  for (int v = 0; v < 101; ++v) image.classes.at(100, v) = 1;  // x = 1 m from 2 m above
  const ClassImageModel model =
      ClassImageModel::create(three_classes(),
                              {.evidence = {.resolution_m = 0.01}, .ground_m = 1.0})
          .value();
  const auto grids = model.grids(image).value();
  EXPECT_EQ(class_at(grids[1], 0.501, 0.0), 847);  // half as far from 1 m above
  EXPECT_EQ(class_at(grids[1], 0.481, 0.0), -405);
}

TEST(ClassImageModel, AnImageThatBreaksItsRulesIsRefused) {
  const ClassImageModel model = ClassImageModel::create(three_classes()).value();
  ClassImage image = from_above();
  image.classes = Image<std::uint16_t>(100, 101, 0);
  EXPECT_EQ(model.grids(image).error().field, "classes");
  EXPECT_EQ(ClassImageModel::create({}).error().field, "classes");
  EXPECT_EQ(validate(ClassImageOptions{.max_range_m = 0.0}).error().field, "max_range_m");
}

TEST(ClassImageModel, AnEmptyImageKnowsNothing) {
  ClassImage image = from_above();
  image.classes = {};
  const auto grids = ClassImageModel::create(three_classes()).value().grids(image).value();
  for (const SensorGrid& sensor : grids) {
    EXPECT_EQ(sensor.grid.num_known(), 0U);
  }
}

}  // namespace
}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
// Where no missed detections are noted, nothing tells what was in view beside what.
#include "hypermap/octree_semantic/mapper/semantic_mapper.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace hypermap {
namespace {

constexpr PinholeCamera kCupboardCamera{160, 120, 131.25, 131.25, 79.5, 59.5};
constexpr float kFarWallM = 3.0F;
constexpr float kLeftM = 1.5F;
constexpr float kRightM = 1.52F;
constexpr int kFirstColumn = 45;
constexpr int kMiddleColumn = 80;
constexpr int kEndColumn = 115;
constexpr int kFirstRow = 20;
constexpr int kEndRow = 100;

/// Two cupboards side by side before a wall, one of which is detected.
RgbdFrame cupboards(std::uint64_t index, bool is_left_detected, ClassId cupboard) {
  RgbdFrame frame;
  frame.index = index;
  frame.stamp = Stamp{static_cast<std::int64_t>(index) * 200'000'000};
  frame.camera = kCupboardCamera;
  frame.depth_m = DepthImage(kCupboardCamera.width_px, kCupboardCamera.height_px, kFarWallM);
  for (int v = kFirstRow; v < kEndRow; ++v) {
    for (int u = kFirstColumn; u < kEndColumn; ++u)
      frame.depth_m.at(u, v) = u < kMiddleColumn ? kLeftM : kRightM;
  }
  const double first = is_left_detected ? kFirstColumn : kMiddleColumn;
  const double end = is_left_detected ? kMiddleColumn : kEndColumn;
  frame.detections = {{.box_px = {first, kFirstRow, end, kEndRow},
                       .class_scores = {{cupboard, Probability(1.0)}},
                       .score = Probability(0.9),
                       .detector = {},
                       .mask = {}}};
  return frame;
}

/// Of the left one in six frames, then of the other one in as many.
std::size_t num_objects(const SemanticMapperOptions& options) {
  ClassRegistry classes;
  const ClassId cupboard = classes.add("cupboard").value();
  SemanticMapper mapper = SemanticMapper::create(options, classes).value();
  for (std::uint64_t index = 0; index < 12; ++index) {
    EXPECT_TRUE(mapper.integrate(cupboards(index, index < 6, cupboard)));
  }
  return mapper.objects().size();
}

TEST(HiddenPartsOfMaps, WhatIsVisibleBesideTheOtherIsTwo) {
  EXPECT_EQ(num_objects({}), 2U);
}

TEST(HiddenPartsOfMaps, WhereMissesAreNotNotedTheyStayTwo) {
  SemanticMapperOptions none_noted;
  none_noted.objects.absence.missed_decay = LogOdds(0.0);
  EXPECT_EQ(num_objects(none_noted), 2U);
}

}  // namespace
}  // namespace hypermap

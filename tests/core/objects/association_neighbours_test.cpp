// SPDX-License-Identifier: BSD-3-Clause
// Objects that touch: told apart, divided, and what one took of the other given back.
#include "core/objects/association_cases.hpp"
#include "hypermap/core/objects/confirmation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::kChairClass;
using testing_support::kFridge;
using testing_support::kOvenClass;
using testing_support::observed;
using testing_support::scores;
using testing_support::seen;
using testing_support::surface_of;

/// A chair and the one that stands back to back with it.
const Box kFrontChair = box_at({0.0, 0, 0.45}, {0.5, 0.5, 0.9});
const Box kRearChair = box_at({0.51, 0, 0.45}, {0.5, 0.5, 0.9});

std::vector<Box> boxes_of(const ObjectMap& map) {
  std::vector<Box> boxes;
  for (const Object& object : map.objects()) boxes.push_back(object.box);
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) {
    return a.min_in_map.x() < b.min_in_map.x();
  });
  return boxes;
}

TEST(AssignmentPolicy, ChairsBackToBackAreTwoWhenOneFrameShowsBoth) {
  ObjectMap map;
  for (std::uint64_t frame = 0; frame < 6; ++frame) {
    (void)associate(
        map,
        std::array{seen(kFrontChair, kChairClass, frame), seen(kRearChair, kChairClass, frame)},
        {});
  }
  ASSERT_EQ(map.size(), 2U);
  EXPECT_NEAR(boxes_of(map)[0].max_in_map.x(), 0.25, 0.03);
  EXPECT_NEAR(boxes_of(map)[1].min_in_map.x(), 0.26, 0.03);
}

TEST(AssignmentPolicy, ChairsThatWereJoinedAreDividedWhenFramesShowTwo) {
  // Single detections took both for one; then a detector shows them beside each other.
  const auto all = surface_of(bounding_box(kFrontChair, kRearChair));
  ObjectMap map;
  std::uint64_t frame = 0;
  for (; frame < 6; ++frame) {
    (void)associate(map, std::array{observed(all, scores(kChairClass, 0.8), frame)}, {});
  }
  ASSERT_EQ(map.size(), 1U);
  for (; frame < 40; ++frame) {
    (void)associate(
        map,
        std::array{seen(kFrontChair, kChairClass, frame), seen(kRearChair, kChairClass, frame)},
        {});
  }
  ASSERT_EQ(map.size(), 2U);
  EXPECT_NEAR(boxes_of(map)[0].max_in_map.x(), 0.25, 0.05);
  EXPECT_NEAR(boxes_of(map)[1].min_in_map.x(), 0.26, 0.05);
  EXPECT_EQ(confirmed_objects(map, {}).size(), 2U);
}

TEST(AssignmentPolicy, ASegmentGoesToTheChairThatItsBoxNearlyHolds) {
  // Of the front chair frames have shown the back alone, of the rear one all.
  const Box back = box_at({0.15, 0, 0.75}, {0.03, 0.5, 0.3});
  ObjectMap map;
  ObjectId front = kNoObject;
  std::uint64_t frame = 0;
  for (; frame < 6; ++frame) {
    front =
        associate(map,
                  std::array{seen(back, kChairClass, frame), seen(kRearChair, kChairClass, frame)},
                  {})
            .object_of_observation[0];
  }
  ASSERT_EQ(map.size(), 2U);
  // A segment of all of the front chair goes on over 14 cm of the rear one.
  const Box leaking = box_at({0.075, 0, 0.45}, {0.65, 0.5, 0.9});
  const auto report = associate(map, std::array{seen(leaking, kChairClass, frame)}, {});
  EXPECT_EQ(report.object_of_observation[0], front);
}

TEST(AssignmentPolicy, WhatSegmentsTookOfANeighbourGoesBackToIt) {
  // Four of ten segments of the refrigerator go on over the oven that touches it.
  const Box fridge = box_at({0, 0, 0.9}, {0.6, 0.6, 1.8});
  const Box oven = box_at({0.61, 0, 0.45}, {0.6, 0.6, 0.9});
  const auto leaking = [&] {
    auto points = surface_of(fridge);
    const auto more = surface_of(oven);
    points.insert(points.end(), more.begin(), more.end());
    return points;
  }();
  ObjectMap map;
  for (std::uint64_t frame = 0; frame < 20; ++frame) {
    const auto of_fridge = frame % 5 < 2 ? leaking : surface_of(fridge);
    (void)associate(
        map,
        std::array{observed(of_fridge, scores(kFridge, 0.8), frame), seen(oven, kOvenClass, frame)},
        {});
  }
  ASSERT_EQ(map.size(), 2U);
  EXPECT_NEAR(boxes_of(map)[0].max_in_map.x(), 0.3, 0.03);
  EXPECT_NEAR(boxes_of(map)[1].min_in_map.x(), 0.31, 0.03);
}

}  // namespace
}  // namespace hypermap

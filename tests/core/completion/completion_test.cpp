// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/completion/completion.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace hypermap {
namespace {

constexpr ClassId kChair{3};
constexpr ClassId kSofa{4};
/// Bearing bins of 20 degrees; bin 0 is looked at from 10 degrees.
constexpr int kFromEast = 0;
constexpr int kFromNorthEast = 2;  // 50 degrees
constexpr int kFromWest = 9;       // 190 degrees

void detect(Object& object, int bin, ClassId named = kChair) {
  const double bearing_rad = (bin + 0.5) * 2.0 * M_PI / ObservationLog::kNumBearingBins;
  object.observation_log.add(
      {.class_id = named, .bearing_rad = static_cast<float>(bearing_rad), .distance_m = 2.0F});
}

/// An object whose outline is its box: it has no points.
Object seen_from(const std::vector<int>& bins, const Box& box, ClassId named = kChair) {
  Object object;
  object.box = box;
  for (const int bin : bins) detect(object, bin, named);
  return object;
}

std::vector<int> all_around() {
  std::vector<int> bins(ObservationLog::kNumBearingBins);
  std::iota(bins.begin(), bins.end(), 0);
  return bins;
}

Box box_of(double x_m, double y_m, double z_m) {
  return {Eigen::Vector3d::Zero(), {x_m, y_m, z_m}};
}

/// Points of an upright box around the origin that is turned by `yaw_rad`.
Object with_turned_points(double yaw_rad, const Eigen::Vector3d& size) {
  const Eigen::AngleAxisd turn(yaw_rad, Eigen::Vector3d::UnitZ());
  auto points = testing_support::surface_of(testing_support::box_at({0, 0, size.z() / 2}, size));
  for (Eigen::Vector3f& point : points) point = (turn * point.cast<double>()).cast<float>();
  Object object;
  object.points.observe(points);
  object.box = object.points.agreed_box().value();
  return object;
}

TEST(SeenShare, IsTheLengthOfTheSidesThatWereFaced) {
  const Box box = box_of(2.0, 1.0, 0.5);  // outline 6 m; the sides to the east and west have 1 m
  EXPECT_DOUBLE_EQ(seen_share(seen_from({}, box)), 0.0);
  EXPECT_DOUBLE_EQ(seen_share(seen_from({kFromEast}, box)), 1.0 / 6.0);
  EXPECT_DOUBLE_EQ(seen_share(seen_from({kFromNorthEast}, box)), 3.0 / 6.0);
  EXPECT_DOUBLE_EQ(seen_share(seen_from({kFromEast, kFromWest}, box)), 2.0 / 6.0);
  EXPECT_DOUBLE_EQ(seen_share(seen_from(all_around(), box)), 1.0);
}

TEST(SeenShare, ASideIsFacedUpToSixtyDegrees) {
  const Box box = box_of(2.0, 1.0, 0.5);
  EXPECT_DOUBLE_EQ(seen_share(seen_from({3}, box)), 2.0 / 6.0);  // 70 degrees: the north alone
}

TEST(SeenShare, FramesThatShouldHaveShownItAndDidNotAreNone) {
  Object object = seen_from({kFromEast}, box_of(2.0, 1.0, 0.5));
  const double before = seen_share(object);
  object.observation_log.add({.kind = ObservationKind::kMissedDetection, .bearing_rad = 3.0F});
  EXPECT_DOUBLE_EQ(seen_share(object), before);
}

TEST(SeenShare, NeverFallsWithFurtherDetections) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any_bin(0, ObservationLog::kNumBearingBins - 1);
  for (int turn = 0; turn < 8; ++turn) {
    Object object = with_turned_points(0.2 * turn, {0.6, 0.3, 0.4});
    double share = seen_share(object);
    EXPECT_EQ(share, 0.0);
    for (int i = 0; i < 30; ++i) {
      detect(object, any_bin(random));
      EXPECT_GE(seen_share(object), share);
      share = seen_share(object);
      EXPECT_LE(share, 1.0);
    }
    EXPECT_GT(share, 0.5);
  }
}

/// The map of these objects, and the usual sizes of all of them.
UsualSizes sizes_of(const std::vector<Object>& objects) {
  ObjectMap map;
  std::vector<ObjectId> ids;
  ids.reserve(objects.size());
  for (const Object& object : objects) ids.push_back(map.add(object));
  return usual_sizes(map, ids);
}

TEST(UsualSizes, AreMediansOfWhatWasSeenWhole) {
  const UsualSizes odd = sizes_of({seen_from(all_around(), box_of(0.5, 0.4, 0.9)),
                                   seen_from(all_around(), box_of(0.3, 0.6, 0.8)),
                                   seen_from(all_around(), box_of(0.7, 0.65, 0.7)),
                                   seen_from({kFromWest}, box_of(0.1, 0.4, 0.1))});
  ASSERT_EQ(odd.of_class.size(), 1U);
  EXPECT_EQ(odd.of_class.at(kChair),
            (UsualSize{.longer_m = 0.6, .shorter_m = 0.4, .height_m = 0.8, .num_objects = 3}));
  const UsualSizes even = sizes_of({seen_from(all_around(), box_of(0.5, 0.25, 1.0)),
                                    seen_from(all_around(), box_of(0.75, 0.5, 0.5))});
  EXPECT_EQ(even.of_class.at(kChair),
            (UsualSize{.longer_m = 0.625, .shorter_m = 0.375, .height_m = 0.75, .num_objects = 2}));
}

TEST(UsualSizes, OneObjectIsNoHabitAndNoObjectsNone) {
  const Box box = box_of(0.5, 0.4, 0.9);
  EXPECT_TRUE(sizes_of({}).of_class.empty());
  EXPECT_EQ(sizes_of({}).lowest_m, 0.0);
  EXPECT_TRUE(sizes_of({seen_from(all_around(), box, kChair), seen_from(all_around(), box, kSofa)})
                  .of_class.empty());
}

TEST(UsualSizes, KnowTheLowestBottomAlsoOfWhatWasNotSeenWhole) {
  Object low = seen_from({kFromWest}, box_of(0.1, 0.4, 0.1));
  low.box.min_in_map.z() = -0.3;
  EXPECT_DOUBLE_EQ(sizes_of({low, seen_from({}, box_of(1, 1, 1))}).lowest_m, -0.3);
}

TEST(UsualSizes, TurnedObjectsHaveTheSidesTheyWouldHaveUnturned) {
  std::vector<Object> turned;
  for (const double yaw_rad : {0.5, M_PI / 4}) {
    turned.push_back(with_turned_points(yaw_rad, {0.6, 0.3, 0.4}));
    for (const int bin : all_around()) detect(turned.back(), bin);
  }
  const UsualSize size = sizes_of(turned).of_class.at(kChair);
  EXPECT_NEAR(size.longer_m, 0.6, 0.03);
  EXPECT_NEAR(size.shorter_m, 0.3, 0.03);
}

const UsualSizes kUsual{.of_class = {{kChair, {0.5, 0.45, 0.9, 2}}}, .lowest_m = 0.0};

/// The back of a chair: 0.1 m thick in x, 0.5 m wide in y, as high as chairs are.
const Box kBack{{1.0, 2.0, 0.0}, {1.1, 2.5, 0.9}};

bool nothing_known(const PointInMap& /*point*/) {
  return false;
}

void expect_box(const std::optional<Box>& box,
                const Eigen::Vector3d& low,
                const Eigen::Vector3d& high) {
  ASSERT_TRUE(box.has_value());
  EXPECT_TRUE(box->min_in_map.isApprox(low, 1e-12)) << box->min_in_map.transpose();
  EXPECT_TRUE(box->max_in_map.isApprox(high, 1e-12)) << box->max_in_map.transpose();
}

TEST(CompletedBox, TheFaceThatNobodyFacedMovesAwayFromTheViewers) {
  // 0.45 is usual across the back, 0.1 was seen: 0.35 is lacking.
  expect_box(completed_box(seen_from({kFromWest}, kBack), kUsual, nothing_known),
             {1.0, 2.0, 0.0},
             {1.45, 2.5, 0.9});
  expect_box(completed_box(seen_from({kFromEast}, kBack), kUsual, nothing_known),
             {0.65, 2.0, 0.0},
             {1.1, 2.5, 0.9});
}

TEST(CompletedBox, GoesNotWhereTheSpaceIsFree) {
  // The chair behind the table: its back was faced over the table, its seat is hidden below that.
  const Object object = seen_from({kFromWest}, kBack);
  const KnownFree behind = [](const PointInMap& point) { return point.xyz.x() > 1.1; };
  expect_box(completed_box(object, kUsual, behind), {0.65, 2.0, 0.0}, {1.1, 2.5, 0.9});
  const KnownFree around = [](const PointInMap&) { return true; };
  EXPECT_FALSE(completed_box(object, kUsual, around).has_value());
}

TEST(CompletedBox, OfTwoEndsTheOneWithClearlyLessFreeSpace) {
  // Halves of what would be added: 0.5 known to be free in the east, nothing in the west.
  const KnownFree above = [](const PointInMap& point) {
    return point.xyz.x() > 1.1 && point.xyz.z() > 0.45;
  };
  expect_box(completed_box(seen_from({kFromWest}, kBack), kUsual, above),
             {0.65, 2.0, 0.0},
             {1.1, 2.5, 0.9});
}

TEST(CompletedBox, WhereEitherEndMayBeItNothingIsGuessed) {
  const Object both = seen_from({kFromEast, kFromWest}, {{1.0, 2.0, 0.0}, {1.2, 2.35, 0.9}});
  EXPECT_LT(seen_share(both), kWholeSeenShare);  // lacks 0.3 in x and 0.1 in y
  EXPECT_FALSE(completed_box(both, kUsual, nothing_known).has_value());
  const Object neither = seen_from({}, kBack);
  EXPECT_FALSE(completed_box(neither, kUsual, nothing_known).has_value());
}

TEST(CompletedBox, IsOfKnownClassesNotSeenWholeAndSmallerThanUsual) {
  EXPECT_FALSE(
      completed_box(seen_from({kFromWest}, kBack, kSofa), kUsual, nothing_known).has_value());
  EXPECT_FALSE(completed_box(seen_from(all_around(), kBack), kUsual, nothing_known).has_value());
  const Object large = seen_from({kFromWest}, {{0, 0, 0}, {2.0, 1.0, 1.0}});
  EXPECT_LT(seen_share(large), kWholeSeenShare);
  EXPECT_FALSE(completed_box(large, kUsual, nothing_known).has_value());
  const Object small = seen_from({kFromWest}, {{0, 0, 0}, {0.31, 0.5, 0.86}});  // of 0.45, 0.9
  EXPECT_FALSE(completed_box(small, kUsual, nothing_known).has_value());
  const UsualSizes of_cups{.of_class = {{kChair, {0.09, 0.09, 0.1, 2}}}, .lowest_m = 0.0};
  const Object thin = seen_from({kFromWest}, {{0, 0, 0}, {0.05, 0.09, 0.1}});  // 4 cm is nothing
  EXPECT_FALSE(completed_box(thin, of_cups, nothing_known).has_value());
}

TEST(CompletedBox, WhatHangsInTheAirReachesDownToTheLowestBottomAlone) {
  const auto thick = [](double bottom_m, double top_m) {
    return seen_from({kFromWest}, {{1.0, 2.0, bottom_m}, {1.45, 2.5, top_m}});
  };
  // 0.4 is lacking; the top was seen, so it is below.
  expect_box(
      completed_box(thick(0.5, 1.0), kUsual, nothing_known), {1.0, 2.0, 0.1}, {1.45, 2.5, 1.0});
  expect_box(
      completed_box(thick(0.3, 0.8), kUsual, nothing_known), {1.0, 2.0, 0.0}, {1.45, 2.5, 0.8});
  // What stands on the floor goes on upwards, where the camera did not look.
  expect_box(
      completed_box(thick(0.0, 0.5), kUsual, nothing_known), {1.0, 2.0, 0.0}, {1.45, 2.5, 0.9});
}

TEST(CompletedBox, OfTwoUsualSidesTheSeenOneIsTheNearer) {
  // 0.46 wide is the shorter side, 0.45; the other one lacks 0.4 of 0.5.
  expect_box(
      completed_box(
          seen_from({kFromWest}, {{1.0, 2.0, 0.0}, {1.1, 2.46, 0.9}}), kUsual, nothing_known),
      {1.0, 2.0, 0.0},
      {1.5, 2.46, 0.9});
}

TEST(CompletedBox, TurnedObjectsGrowAlongTheirOwnSides) {
  // A slab of 0.5 by 0.1 around the origin, its long side along 60 degrees, seen along its short
  // one from 330 degrees: it lacks 0.35 towards 150 degrees.
  Object object = with_turned_points(M_PI / 3, {0.5, 0.1, 0.9});
  detect(object, 16);
  const auto box = completed_box(object, kUsual, nothing_known);
  ASSERT_TRUE(box.has_value());
  const Eigen::Vector2d along(std::cos(M_PI / 3), std::sin(M_PI / 3));
  const Eigen::Vector2d away(-along.y(), along.x());
  Eigen::Vector2d low(10, 10);
  Eigen::Vector2d high(-10, -10);
  for (const double a : {-0.25, 0.25}) {
    for (const double b : {-0.05, 0.4}) {
      low = low.cwiseMin(a * along + b * away);
      high = high.cwiseMax(a * along + b * away);
    }
  }
  EXPECT_TRUE(box->min_in_map.head<2>().isApprox(low, 0.05)) << box->min_in_map.transpose();
  EXPECT_TRUE(box->max_in_map.head<2>().isApprox(high, 0.05)) << box->max_in_map.transpose();
}

TEST(CompletedBox, NeverTakesAnythingAway) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> length(0.02, 1.0);
  std::uniform_int_distribution<int> any_bin(0, ObservationLog::kNumBearingBins - 1);
  int guesses = 0;
  for (int i = 0; i < 200; ++i) {
    const Object object =
        seen_from({any_bin(random)}, box_of(length(random), length(random), length(random)));
    const double wall_m = length(random);
    const KnownFree is_free = [&](const PointInMap& point) { return point.xyz.x() > wall_m; };
    const auto box = completed_box(object, kUsual, is_free);
    if (!box) continue;
    ++guesses;
    EXPECT_TRUE(box->contains(object.box.min_in_map) && box->contains(object.box.max_in_map));
    EXPECT_GT(box->volume_m3(), object.box.volume_m3());
    EXPECT_GE(box->min_in_map.z(), -1e-12);
  }
  EXPECT_GT(guesses, 20);
}

}  // namespace
}  // namespace hypermap

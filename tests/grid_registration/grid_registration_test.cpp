// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/grid_registration/grid_registration.hpp"

#include "made_rooms.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace hypermap::test {
namespace {

/// All of a room, and a rim.
GridGeometry whole_room() {
  return {.resolution_m = 0.05, .origin = Eigen::Vector2d(-0.5, -0.5), .cols = 200, .rows = 180};
}

/// What a sensor sees about itself: 5 m x 4 m in its own frame.
GridGeometry sensors_view() {
  return {.resolution_m = 0.05, .origin = Eigen::Vector2d(-2.5, -2.0), .cols = 100, .rows = 80};
}

Eigen::Matrix3d in_room() {
  return Eigen::Matrix3d::Identity();
}

/// Somewhere in the middle of the room, turned by `yaw_rad`, at no whole number of cells.
Eigen::Matrix3d somewhere(const PlanRoom& room, std::uint64_t seed, double yaw_rad) {
  CounterRng random(seed, 5);
  const Eigen::Vector2d place = room.size / 2.0;
  return plane_pose(
      place.x() + random.uniform(-0.7, 0.7), place.y() + random.uniform(-0.7, 0.7), yaw_rad);
}

TEST(GridRegistration, ShiftsAndTurnsAreRecoveredToHalfACell) {
  for (std::uint64_t seed = 0; seed < repetitions<std::uint64_t>(8); ++seed) {
    const PlanRoom room = furnished_room(seed);
    const LogOddsGrid fixed = seen_room(room, whole_room(), in_room());
    const double yaw = static_cast<double>(seed) * 0.8 - 3.0;
    const Eigen::Matrix3d truth = somewhere(room, seed, yaw);
    const LogOddsGrid moving = seen_room(room, sensors_view(), truth);
    const auto found = register_grids(moving, fixed);
    ASSERT_TRUE(found.has_value()) << seed << ": " << to_string(found.error());
    EXPECT_LE(most_apart(found->fixed_from_moving, truth, sensors_view()), 0.5) << seed;
  }
}

TEST(GridRegistration, NoiseIsBorne) {
  for (std::uint64_t seed = 0; seed < repetitions<std::uint64_t>(8); ++seed) {
    const PlanRoom room = furnished_room(seed + 20);
    const LogOddsGrid fixed =
        seen_room(room, whole_room(), in_room(), {.wrong_share = 0.03, .seed = seed});
    const Eigen::Matrix3d truth = somewhere(room, seed, 0.3 * static_cast<double>(seed));
    const LogOddsGrid moving =
        seen_room(room, sensors_view(), truth, {.wrong_share = 0.05, .seed = seed + 100});
    const auto found = register_grids(moving, fixed);
    ASSERT_TRUE(found.has_value()) << seed << ": " << to_string(found.error());
    EXPECT_LE(most_apart(found->fixed_from_moving, truth, sensors_view()), 0.5) << seed;
  }
}

TEST(GridRegistration, OneReadingIsPlacedInAMapThatIsSurer) {
  for (std::uint64_t seed = 0; seed < repetitions<std::uint64_t>(8); ++seed) {
    const PlanRoom room = furnished_room(seed);
    const LogOddsGrid fixed = seen_room(room, whole_room(), in_room(), {.sureness = 4.0});
    const Eigen::Matrix3d truth = somewhere(room, seed, 0.4 * static_cast<double>(seed));
    const LogOddsGrid moving = seen_room(room, sensors_view(), truth, {.sureness = 0.3});
    const auto found = register_grids(moving, fixed);
    ASSERT_TRUE(found.has_value()) << seed << ": " << to_string(found.error());
    EXPECT_LE(most_apart(found->fixed_from_moving, truth, sensors_view()), 0.5) << seed;
  }
}

TEST(GridRegistration, ScaleAndTiltAreRecoveredOnRequest) {
  for (std::uint64_t seed = 0; seed < repetitions<std::uint64_t>(4); ++seed) {
    const PlanRoom room = furnished_room(seed + 40);
    const LogOddsGrid fixed = seen_room(room, whole_room(), in_room());
    Eigen::Matrix3d truth = somewhere(room, seed, 0.4);
    truth.topLeftCorner<2, 2>() *= 1.12;
    const auto similar = register_grids(
        seen_room(room, sensors_view(), truth), fixed, {.kind = RegistrationKind::kSimilarity});
    ASSERT_TRUE(similar.has_value()) << seed << ": " << to_string(similar.error());
    EXPECT_LE(most_apart(similar->fixed_from_moving, truth, sensors_view()), 0.5) << seed;

    truth = somewhere(room, seed, -0.5);
    Eigen::Matrix3d tilt = Eigen::Matrix3d::Identity();
    tilt(2, 0) = 0.01;  // 2.5 % at the grid's end
    tilt(2, 1) = -0.008;
    tilt(0, 1) = 0.02;
    truth = truth * tilt;
    const auto tilted = register_grids(
        seen_room(room, sensors_view(), truth), fixed, {.kind = RegistrationKind::kHomography});
    ASSERT_TRUE(tilted.has_value()) << seed << ": " << to_string(tilted.error());
    EXPECT_LE(most_apart(tilted->fixed_from_moving, truth, sensors_view()), 0.5) << seed;
  }
}

TEST(GridRegistration, ResolutionsMayDiffer) {
  const PlanRoom room = furnished_room(3);
  const LogOddsGrid fixed = seen_room(room, whole_room(), in_room());
  GridGeometry fine = sensors_view();
  fine.resolution_m = 0.04;
  fine.cols = 125;
  fine.rows = 100;
  fine.yaw_rad = 0.2;
  const Eigen::Matrix3d truth = somewhere(room, 3, 0.7);
  const auto found = register_grids(seen_room(room, fine, truth), fixed);
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_LE(most_apart(found->fixed_from_moving, truth, fine), 0.5);
}

/// The reason for which the room's own grid is refused, seen from its middle.
std::string refusal_of(const PlanRoom& room, const GridRegistrationOptions& options = {}) {
  const LogOddsGrid fixed = seen_room(room, whole_room(), in_room());
  const Eigen::Matrix3d truth = plane_pose(room.size.x() / 2.0, room.size.y() / 2.0, 0.0);
  const auto found = register_grids(seen_room(room, sensors_view(), truth), fixed, options, truth);
  if (found) return "registered, rival " + std::to_string(found->rival_share);
  EXPECT_EQ(found.error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(found.error().what.empty());
  return found.error().field;
}

TEST(GridRegistration, ASymmetricRoomIsAmbiguous) {
  // Half a turn about the room's middle puts each pillar on another one.
  const PlanRoom room{{4.6, 3.6},
                      {{{1.0, 1.0}, {0.2, 0.2}, 0.3},
                       {{3.6, 2.6}, {0.2, 0.2}, 0.3},
                       {{2.0, 2.9}, {0.3, 0.1}, 0.0},
                       {{2.6, 0.7}, {0.3, 0.1}, 0.0}}};
  EXPECT_EQ(refusal_of(room), "rivals");
  // Who knows the turn to a quarter is not misled.
  EXPECT_EQ(refusal_of(room, {.max_turn_rad = 0.5}).substr(0, 10), "registered");
}

TEST(GridRegistration, ACorridorIsAmbiguous) {
  // Pillars along both walls, a metre apart.
  PlanRoom corridor{{9.0, 2.0}, {}};
  for (int i = 0; i < 9; ++i) {
    corridor.furniture.push_back({{0.5 + i, 0.1}, {0.15, 0.15}, 0.0});
    corridor.furniture.push_back({{0.5 + i, 1.9}, {0.15, 0.15}, 0.0});
  }
  EXPECT_EQ(refusal_of(corridor), "rivals");
}

TEST(GridRegistration, BareWallsOfACorridorAreRefused) {
  const std::string why = refusal_of({{9.0, 2.0}, {}});
  EXPECT_TRUE(why == "rivals" || why == "features" || why == "inliers") << why;
}

TEST(GridRegistration, GridsThatShowNothingAreRefused) {
  const LogOddsGrid room = seen_room(furnished_room(1), whole_room(), in_room());
  const LogOddsGrid unknown = LogOddsGrid::create(sensors_view()).value();
  EXPECT_EQ(register_grids(unknown, room).error().field, "features");
  EXPECT_EQ(register_grids(room, unknown).error().field, "features");
  LogOddsGrid empty = unknown;
  for (int row = 0; row < 80; ++row) {
    for (int col = 0; col < 100; ++col) empty.set({col, row}, -400);
  }
  EXPECT_EQ(register_grids(empty, room).error().field, "features");
  EXPECT_EQ(register_grids(empty, room).error().code, ErrorCode::kNotFound);
}

TEST(GridRegistration, AnotherRoomIsRefused) {
  for (std::uint64_t seed = 0; seed < repetitions<std::uint64_t>(4); ++seed) {
    const LogOddsGrid fixed = seen_room(furnished_room(seed), whole_room(), in_room());
    const PlanRoom other = furnished_room(seed + 60);
    const auto found =
        register_grids(seen_room(other, sensors_view(), somewhere(other, seed, 0.2)), fixed);
    EXPECT_FALSE(found.has_value()) << seed << " agreement " << found->agreement;
  }
}

TEST(GridRegistration, TheGuessLimitsWhereItIsLookedFor) {
  const PlanRoom room = furnished_room(4);
  const LogOddsGrid fixed = seen_room(room, whole_room(), in_room());
  const Eigen::Matrix3d truth = somewhere(room, 4, 0.3);
  const LogOddsGrid moving = seen_room(room, sensors_view(), truth);
  const GridRegistrationOptions near{.max_shift_m = 0.5, .max_turn_rad = 0.2};
  EXPECT_TRUE(register_grids(moving, fixed, near, truth * plane_pose(0.2, 0.1, 0.1)).has_value());
  const auto far = register_grids(moving, fixed, near, truth * plane_pose(2.0, 0.0, 0.0));
  EXPECT_FALSE(far.has_value());
}

TEST(GridRegistration, SameGridsGiveTheSameBits) {
  const PlanRoom room = furnished_room(5);
  const LogOddsGrid fixed = seen_room(room, whole_room(), in_room());
  const LogOddsGrid moving = seen_room(room, sensors_view(), somewhere(room, 5, 1.0));
  const auto once = register_grids(moving, fixed);
  const auto again = register_grids(moving, fixed);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->fixed_from_moving, again->fixed_from_moving);
  EXPECT_EQ(once->num_inliers, again->num_inliers);
  EXPECT_EQ(once->rival_share, again->rival_share);
}

TEST(GridRegistration, WrongArgumentsAreNamed) {
  const LogOddsGrid room = seen_room(furnished_room(1), whole_room(), in_room());
  EXPECT_EQ(register_grids(LogOddsGrid(), room).error().field, "moving");
  EXPECT_EQ(register_grids(room, LogOddsGrid()).error().field, "fixed");
  EXPECT_EQ(register_grids(room, room, {}, Eigen::Matrix3d::Zero()).error().field, "guess");
  EXPECT_EQ(validate(GridRegistrationOptions{.min_inliers = 2}).error().field, "min_inliers");
  const LogOddsGrid wide =
      LogOddsGrid::create({.resolution_m = 0.05, .cols = 5000, .rows = 1}).value();
  EXPECT_EQ(register_grids(wide, room).error().code, ErrorCode::kLimit);
}

TEST(FuseRegistered, AMisplacedGridIsFusedWhereItBelongs) {
  const PlanRoom room = furnished_room(6);
  GridStack stack = GridStack::create(whole_room()).value();
  const SensorGrid map{.layer = "/ism/map", .grid = seen_room(room, whole_room(), in_room())};
  ASSERT_TRUE(stack.fuse(map, in_room()).has_value());
  const Eigen::Matrix3d truth = somewhere(room, 6, 0.5);
  const SensorGrid scan{.layer = "/ism/scan", .grid = seen_room(room, sensors_view(), truth)};
  const Eigen::Matrix3d odometry = truth * plane_pose(0.3, -0.2, 0.08);

  const auto before = stack;
  EXPECT_EQ(fuse_registered(stack, scan, "/ism/none").error().field, "reference");
  EXPECT_EQ(stack, before);
  const auto fused =
      fuse_registered(stack, scan, "/ism/map", {.max_shift_m = 1.0, .max_turn_rad = 0.3}, odometry);
  ASSERT_TRUE(fused.has_value()) << to_string(fused.error());
  EXPECT_GT(fused->num_reached, 5000U);
  GridStack rightly = before;
  ASSERT_TRUE(rightly.fuse(scan, truth).has_value());
  // What was fused says what it would have said at its true place.
  const auto found = stack.layers().at("/ism/scan").cells();
  const auto wanted = rightly.layers().at("/ism/scan").cells();
  std::size_t num_known = 0;
  std::size_t num_other = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    num_known += wanted[i] != 0 ? 1U : 0U;
    num_other += (wanted[i] > 0) != (found[i] > 0) ? 1U : 0U;
  }
  EXPECT_LT(static_cast<double>(num_other), 0.02 * static_cast<double>(num_known));
}

}  // namespace
}  // namespace hypermap::test

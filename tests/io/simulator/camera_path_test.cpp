// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/camera_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;

Vector3d gaze(const MapFromCamera& pose) {
  return pose.isometry().linear().col(2);
}
double heading(const MapFromCamera& pose) {
  return std::atan2(gaze(pose).y(), gaze(pose).x());
}

TEST(CameraPath, ACameraThatLooksAlongXHasItsAxesThere) {
  const MapFromCamera pose = look_at({1, 2, 3}, {5, 2, 3});
  const Eigen::Matrix3d axes = pose.isometry().linear();
  EXPECT_TRUE(axes.col(0).isApprox(-Vector3d::UnitY(), 1e-12));  // right
  EXPECT_TRUE(axes.col(1).isApprox(-Vector3d::UnitZ(), 1e-12));  // down
  EXPECT_TRUE(axes.col(2).isApprox(Vector3d::UnitX(), 1e-12));   // forward
  EXPECT_EQ(pose.origin().xyz, Vector3d(1, 2, 3));
}

TEST(CameraPath, ThePointLookedAtIsInTheMiddleOfTheImage) {
  const MapFromCamera pose = look_at({1, -2, 1.4}, {-3, 0.5, 0.2});
  const Vector3d in_camera = (pose.inverse() * PointInMap{{-3, 0.5, 0.2}}).xyz;
  EXPECT_NEAR(in_camera.x(), 0.0, 1e-12);
  EXPECT_NEAR(in_camera.y(), 0.0, 1e-12);
  EXPECT_NEAR(in_camera.z(), std::hypot(4.0, 2.5, 1.2), 1e-12);
  EXPECT_NEAR(pose.isometry().linear().determinant(), 1.0, 1e-12);
}

TEST(CameraPath, ALegTakesWhatTheSlowerOfDrivingAndTurningNeeds) {
  // 3 m at 0.5 m/s without turning: 6 s. Then 1 m (2 s) with a quarter turn at pi/8 per s: 4 s.
  const auto path =
      CameraPath::create({{{0, 0, 1}, {9, 0, 1}}, {{3, 0, 1}, {9, 0, 1}}, {{4, 0, 1}, {4, 9, 1}}},
                         {.speed_m_per_s = 0.5, .turn_rate_rad_per_s = kPi / 8});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->duration_s(), 10.0, 1e-12);
}

TEST(CameraPath, StopsAreReachedExactly) {
  const auto path =
      CameraPath::create({{{0, 0, 1}, {9, 0, 1}}, {{3, 0, 1}, {9, 0, 1}}, {{4, 0, 1}, {4, 9, 1}}},
                         {.speed_m_per_s = 0.5, .turn_rate_rad_per_s = kPi / 8});
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->pose_at(6.0).origin().xyz.isApprox(Vector3d(3, 0, 1), 1e-12));
  EXPECT_NEAR(heading(path->pose_at(6.0)), 0.0, 1e-12);
  EXPECT_TRUE(path->pose_at(10.0).origin().xyz.isApprox(Vector3d(4, 0, 1), 1e-12));
  EXPECT_NEAR(heading(path->pose_at(10.0)), kPi / 2, 1e-12);
}

TEST(CameraPath, BeyondTheEndsTheCameraStandsStill) {
  const auto path = CameraPath::create({{{0, 0, 1}, {9, 0, 1}}, {{3, 0, 1}, {9, 1, 1}}}, {});
  ASSERT_TRUE(path);
  EXPECT_TRUE(path->pose_at(-5.0).isometry().isApprox(path->pose_at(0.0).isometry()));
  EXPECT_TRUE(path->pose_at(1e9).isometry().isApprox(path->pose_at(path->duration_s()).isometry()));
}

TEST(CameraPath, HalfWayBetweenTwoStopsIsTheMiddle) {
  // One leg, at rest at both ends: the cubic is symmetric.
  const auto path = CameraPath::create({{{0, 0, 1}, {9, 0, 1}}, {{3, 0, 2}, {12, 0, 2}}}, {});
  ASSERT_TRUE(path);
  const MapFromCamera middle = path->pose_at(0.5 * path->duration_s());
  EXPECT_TRUE(middle.origin().xyz.isApprox(Vector3d(1.5, 0, 1.5), 1e-12));
}

TEST(CameraPath, TheGazeTurnsTheShortWayRound) {
  // From heading 170 to -170 degrees: through 180, never through 0.
  const double a = 170.0 * kPi / 180.0;
  const auto path = CameraPath::create(
      {{{0, 0, 1}, {std::cos(a), std::sin(a), 1}}, {{0, 0, 1}, {std::cos(a), -std::sin(a), 1}}},
      {});
  ASSERT_TRUE(path);
  for (double t = 0.0; t <= path->duration_s(); t += 0.01)
    EXPECT_LT(gaze(path->pose_at(t)).x(), -0.98);
}

TEST(CameraPath, CurvesNeverOvershootTheirStops) {
  const auto path = CameraPath::create({{{0, 0, 1}, {9, 0, 1}},
                                        {{3, 0, 1}, {9, 0, 1}},
                                        {{3, 0, 1}, {3, 9, 1}},
                                        {{0, 0.1, 1}, {0, 9, 1}}},
                                       {});
  ASSERT_TRUE(path);
  for (double t = 0.0; t <= path->duration_s(); t += 0.01) {
    const Vector3d position = path->pose_at(t).origin().xyz;
    EXPECT_GE(position.x(), -1e-12);
    EXPECT_LE(position.x(), 3.0 + 1e-12);
    EXPECT_LE(position.y(), 0.1 + 1e-12);
  }
}

TEST(CameraPath, TheCameraNeverRolls) {
  const auto path = CameraPath::create(
      {{{0, 0, 1}, {2, 0, 0}}, {{3, 0, 2}, {4, 5, 2.5}}, {{1, 4, 1}, {-4, 0, 1}}}, {});
  ASSERT_TRUE(path);
  for (double t = 0.0; t <= path->duration_s(); t += 0.1)
    EXPECT_NEAR(path->pose_at(t).isometry().linear()(2, 0), 0.0, 1e-12);  // x axis level
}

TEST(CameraPath, BadWaypointsAndSpeedsAreRefused) {
  const CameraWaypoint good{{0, 0, 1}, {9, 0, 1}};
  EXPECT_FALSE(CameraPath::create({good}, {}));
  EXPECT_FALSE(CameraPath::create({good, {{1, 0, 1}, {1, 0, 0}}}, {}));  // straight down
  EXPECT_FALSE(CameraPath::create({good, {{1, 0, std::nan("")}, {9, 0, 1}}}, {}));
  EXPECT_EQ(CameraPath::create({good, good}, {.speed_m_per_s = 0.0}).error().field,
            "path.speed_m_per_s");
  EXPECT_EQ(CameraPath::create({good, good}, {.turn_rate_rad_per_s = std::nan("")}).error().field,
            "path.turn_rate_rad_per_s");
  EXPECT_FALSE(CameraPath::create({good, good}, {.turn_rate_rad_per_s = -1.0}));
}

TEST(CameraPath, TwoEqualStopsAreStillAPath) {
  const CameraWaypoint stop{{0, 0, 1}, {9, 0, 1}};
  const auto path = CameraPath::create({stop, stop}, {});
  ASSERT_TRUE(path);
  EXPECT_GT(path->duration_s(), 0.0);
  EXPECT_TRUE(path->pose_at(0.1).isometry().matrix().allFinite());
}

}  // namespace
}  // namespace hypermap

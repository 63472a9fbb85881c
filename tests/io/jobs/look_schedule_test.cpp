// SPDX-License-Identifier: BSD-3-Clause
#include "look_schedule.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace hypermap {
namespace {

MapFromCamera pose_at(double x_m, double yaw_rad = 0.0) {
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.translation().x() = x_m;
  isometry.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return MapFromCamera(isometry);
}

/// The positions, from 0 on, that are taken of a walk.
std::vector<std::size_t> taken(const LookOptions& options, const std::vector<MapFromCamera>& walk) {
  LookSchedule schedule(options);
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < walk.size(); ++i) {
    if (schedule.take(i, walk[i])) positions.push_back(i);
  }
  return positions;
}

using Positions = std::vector<std::size_t>;

TEST(LookSchedule, EveryNthIsByPosition) {
  const std::vector<MapFromCamera> walk(7, pose_at(0.0));
  EXPECT_EQ(taken({}, walk), (Positions{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(taken({.every = 3}, walk), (Positions{0, 3, 6}));
  // Frames that could not be read are not asked for; the others keep their places.
  LookSchedule schedule({.every = 3});
  EXPECT_FALSE(schedule.take(1, pose_at(0.0)));
  EXPECT_TRUE(schedule.take(3, pose_at(0.0)));
}

TEST(LookSchedule, AKeyframeIsFarFromEachBeforeItOrTurned) {
  const LookOptions options{.rule = LookRule::kKeyframes,
                            .min_distance_m = 0.5,
                            .min_angle_rad = 0.25,
                            .max_gap_frames = 100};
  // 0.5 is not farther than 0.5, 0.6 is; the way back passes known views; turned by 0.3 there is a
  // new one, and turned by 0.5 from the first by 0.2 from that.
  EXPECT_EQ(taken(options,
                  {pose_at(0.0),
                   pose_at(0.5),
                   pose_at(0.6),
                   pose_at(0.4),
                   pose_at(0.0),
                   pose_at(0.0, 0.2),
                   pose_at(0.0, 0.3),
                   pose_at(0.0, 0.5),
                   pose_at(0.0, -0.3)}),
            (Positions{0, 2, 6, 8}));
}

TEST(LookSchedule, AfterTheLargestGapAKnownViewIsLookedAtAgain) {
  const LookOptions options{.rule = LookRule::kKeyframes, .max_gap_frames = 3};
  EXPECT_EQ(taken(options, std::vector<MapFromCamera>(8, pose_at(0.0))), (Positions{0, 3, 6}));
  LookSchedule schedule(options);
  EXPECT_TRUE(schedule.take(5, pose_at(0.0)));  // the first that could be read
  EXPECT_FALSE(schedule.take(7, pose_at(0.0)));
  EXPECT_TRUE(schedule.take(8, pose_at(0.0)));
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/reading_check.hpp"

#include "hypermap/io/dataset/up_axis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

const PinholeCamera kCamera{80, 60, 70.0, 70.0, 39.5, 29.5};

/// How far along `direction` the wall of the box is from inside it, or the box from outside; none
/// where the ray misses.
struct Room {
  Eigen::Vector3d min;
  Eigen::Vector3d max;
};

/// Distances along the ray at which it enters and leaves the box.
std::pair<double, double> through(const Room& box,
                                  const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (box.min[axis] - origin[axis]) / direction[axis];
    const double b = (box.max[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return {enter, leave};
}

/// A room of 6 x 5 x 2.5 m with two cupboards, seen from `pose`; depth by hand.
DepthImage seen_from(const Eigen::Isometry3d& pose) {
  const Room room{{-3.0, -2.0, 0.0}, {3.0, 3.0, 2.5}};
  const std::array cupboards{Room{{1.5, -2.0, 0.0}, {3.0, -0.5, 1.2}},
                             Room{{0.5, 2.0, 0.0}, {1.5, 3.0, 1.9}}};
  DepthImage depth(kCamera.width_px, kCamera.height_px, 0.0F);
  for (int v = 0; v < kCamera.height_px; ++v) {
    for (int u = 0; u < kCamera.width_px; ++u) {
      const Eigen::Vector3d direction = pose.linear() * kCamera.unproject(u, v, 1.0).xyz;
      double distance = through(room, pose.translation(), direction).second;
      for (const Room& cupboard : cupboards) {
        const auto [enter, leave] = through(cupboard, pose.translation(), direction);
        if (enter > 0.0 && enter < leave) distance = std::min(distance, enter);
      }
      depth.at(u, v) = static_cast<float>(distance);
    }
  }
  return depth;
}

/// A camera 1.3 m above the floor that looks along `yaw`, a little down; z is up.
Eigen::Isometry3d camera_at(double x_m, double y_m, double yaw_rad) {
  Eigen::Matrix3d optical;
  optical << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix() *
                  Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()).toRotationMatrix() * optical;
  pose.translation() = Eigen::Vector3d(x_m, y_m, 1.3);
  return pose;
}

RgbdFrame frame_at(const Eigen::Isometry3d& pose) {
  RgbdFrame frame;
  frame.camera = kCamera;
  frame.map_from_camera = MapFromCamera(pose);
  frame.depth_m = seen_from(pose);
  return frame;
}

/// A walk through the room; `step_m` between the frames of a pair, and 6 degrees for each 0.2 m.
std::vector<FramePair> walk(int num_pairs, double step_m = 0.2) {
  std::vector<FramePair> pairs;
  pairs.reserve(static_cast<std::size_t>(num_pairs));
  for (int i = 0; i < num_pairs; ++i) {
    const double x_m = -2.0 + 0.3 * i;
    const double yaw_rad = -0.6 + 0.25 * i;
    pairs.push_back(
        {frame_at(camera_at(x_m, 0.2, yaw_rad)),
         frame_at(camera_at(x_m + step_m, 0.2 + 0.3 * step_m, yaw_rad + 0.5 * step_m))});
  }
  return pairs;
}

using Change = std::function<Eigen::Isometry3d(const Eigen::Isometry3d&)>;

/// The pairs with other poses and with depth times `depth_factor`.
std::vector<FramePair> misread(std::vector<FramePair> pairs,
                               const Change& pose_of,
                               double depth_factor = 1.0) {
  for (FramePair& pair : pairs) {
    for (RgbdFrame* frame : {&pair.first, &pair.second}) {
      frame->map_from_camera = MapFromCamera(pose_of(frame->map_from_camera.isometry()));
      for (float& depth_m : frame->depth_m.pixels()) depth_m *= static_cast<float>(depth_factor);
    }
  }
  return pairs;
}

Eigen::Isometry3d unchanged(const Eigen::Isometry3d& pose) {
  return pose;
}

Eigen::Isometry3d turned(const Eigen::Isometry3d& pose, const Eigen::Matrix3d& by) {
  Eigen::Isometry3d out = pose;
  out.linear() = pose.linear() * by;
  return out;
}

TEST(ReadingCheck, FramesThatAreReadAsMeantAgree) {
  const ReadingCheck check = check_reading(walk(6), {});
  EXPECT_EQ(check.num_pairs, 6U);
  EXPECT_GT(check.taken.share, 0.8);
  EXPECT_FALSE(check.better);
  EXPECT_FALSE(find_misreading(walk(6), {}));
}

TEST(ReadingCheck, AWrongScaleIsNamed) {
  for (const double factor : {5.0, 0.2, 10.0, 0.1, 1000.0, 0.001}) {
    // What was written with 1000 units a metre, read as if it were 1000 / factor.
    const FrameReading taken{.depth_units_per_m = 1000.0 / factor};
    const auto pairs = misread(walk(6), unchanged, factor);
    const ReadingCheck check = check_reading(pairs, taken);
    ASSERT_TRUE(check.better) << factor;
    EXPECT_NEAR(check.better->reading.depth_units_per_m, 1000.0, 1e-9) << factor;
    EXPECT_EQ(check.better->reading.pose_direction, PoseDirection::kCameraToWorld);
    EXPECT_GT(check.better->share, 0.8);
  }
}

TEST(ReadingCheck, PosesOfTheOtherDirectionAreNamed) {
  const auto pairs = misread(walk(6), [](const auto& pose) { return pose.inverse(); });
  const ReadingCheck check = check_reading(pairs, {});
  ASSERT_TRUE(check.better);
  EXPECT_EQ(check.better->reading, (FrameReading{.pose_direction = PoseDirection::kWorldToCamera}));
  // The same read the other way round: the description is wrong, the file is not.
  const FrameReading inverse{.pose_direction = PoseDirection::kWorldToCamera};
  const ReadingCheck back = check_reading(pairs, inverse);
  ASSERT_TRUE(back.better);
  EXPECT_EQ(back.better->reading, FrameReading{});
}

TEST(ReadingCheck, OtherCameraAxesAreNamed) {
  const Eigen::Matrix3d optical_from_opengl = Eigen::Vector3d(1, -1, -1).asDiagonal();
  Eigen::Matrix3d optical_from_robot;
  optical_from_robot << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  for (const auto& [axes, optical_from_axes] :
       {std::pair{CameraAxes::kOpenGl, optical_from_opengl},
        std::pair{CameraAxes::kRobot, optical_from_robot}}) {
    const Eigen::Matrix3d by = optical_from_axes;
    // Poses of these axes, taken for optical ones.
    const auto pairs = misread(walk(6), [&](const auto& pose) { return turned(pose, by); });
    const ReadingCheck check = check_reading(pairs, {});
    ASSERT_TRUE(check.better) << static_cast<int>(axes);
    EXPECT_EQ(check.better->reading, (FrameReading{.camera_axes = axes}));
    // Optical poses, taken for these axes.
    const Eigen::Matrix3d back = by.transpose();
    const auto optical = misread(walk(6), [&](const auto& pose) { return turned(pose, back); });
    const ReadingCheck other = check_reading(optical, {.camera_axes = axes});
    ASSERT_TRUE(other.better) << static_cast<int>(axes);
    EXPECT_EQ(other.better->reading, FrameReading{});
  }
}

TEST(ReadingCheck, InversePosesOfOpenGlAreNamed) {
  const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, -1).asDiagonal();
  const auto pairs = misread(
      walk(6), [&](const auto& pose) { return Eigen::Isometry3d(turned(pose, flip).inverse()); });
  const ReadingCheck check = check_reading(pairs, {});
  ASSERT_TRUE(check.better);
  EXPECT_EQ(check.better->reading,
            (FrameReading{.pose_direction = PoseDirection::kWorldToCamera,
                          .camera_axes = CameraAxes::kOpenGl}));
}

TEST(ReadingCheck, ACameraThatStandsStillBearsOutEveryReading) {
  const auto standing = walk(6, 0.0);
  EXPECT_GT(check_reading(standing, {}).taken.share, 0.95);
  for (const double factor : {1.0, 5.0, 0.1}) {
    EXPECT_FALSE(check_reading(misread(standing, unchanged, factor), {}).better) << factor;
  }
}

TEST(ReadingCheck, TooFewPairsOrTooLittleDepthTellNothing) {
  EXPECT_EQ(check_reading({}, {}).num_pairs, 0U);
  const auto few = misread(walk(2), unchanged, 5.0);
  EXPECT_EQ(check_reading(few, {}).num_pairs, 2U);
  EXPECT_FALSE(check_reading(few, {}).better);
  const auto blind = misread(walk(6), unchanged, 0.0);
  EXPECT_EQ(check_reading(blind, {}).num_pairs, 0U);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(check_reading(misread(walk(6), unchanged, nan), {}).num_pairs, 0U);
}

TEST(ReadingCheck, TheFindingNamesTheFieldAndItsValue) {
  const auto scaled = find_misreading(misread(walk(6), unchanged, 5.0), {});
  ASSERT_TRUE(scaled);
  EXPECT_EQ(scaled->error.field, "depth_scale");
  EXPECT_THAT(scaled->error.what, HasSubstr("\"depth_scale: 5000\""));
  const auto inverse =
      find_misreading(misread(walk(6), [](const auto& pose) { return pose.inverse(); }), {});
  ASSERT_TRUE(inverse);
  EXPECT_THAT(inverse->error.what, HasSubstr("\"pose_direction: world_to_camera\""));
}

TEST(ReadingCheck, DepthThatIsEightTimesTooLargeHasRotatedBits) {
  const auto rotated = find_misreading(misread(walk(6), unchanged, 8.0), {});
  ASSERT_TRUE(rotated);
  EXPECT_EQ(rotated->error.field, "depth_rotated_bits");
  EXPECT_THAT(rotated->error.what, HasSubstr("\"depth_rotated_bits: 3\""));
}

TEST(ReadingCheck, AnUpAxisThatNoCameraHoldsUprightIsNamed) {
  const auto pairs = walk(6, 0.1);
  EXPECT_FALSE(find_wrong_up(pairs, map_from_input_axis("z").value()));
  for (const char* axis : {"y", "-y", "-z", "-x"}) {
    const auto finding = find_wrong_up(pairs, map_from_input_axis(axis).value());
    ASSERT_TRUE(finding) << axis;
    EXPECT_EQ(finding->error.field, "up_axis");
    EXPECT_THAT(finding->error.what, HasSubstr("--up=z"));
  }
  EXPECT_FALSE(find_wrong_up({}, map_from_input_axis("y").value()));
}

TEST(ReadingCheck, ACameraThatNeverTurnsMayLookStraightUp) {
  const FramePair pair = walk(1).front();
  EXPECT_FALSE(find_wrong_up(std::vector(6, pair), map_from_input_axis("y").value()));
}

TEST(ReadingCheck, ACameraHeldOnItsSideIsNoWrongUp) {
  const Eigen::Matrix3d roll =
      Eigen::AngleAxisd(std::numbers::pi / 2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto pairs = misread(walk(6), [&](const auto& pose) { return turned(pose, roll); });
  EXPECT_FALSE(find_wrong_up(pairs, map_from_input_axis("z").value()));
}

TEST(ReadingCheck, CamerasThatDisagreeAboutUpTellNothing) {
  std::vector<FramePair> pairs = walk(6);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Matrix3d roll =
        Eigen::AngleAxisd(static_cast<double>(i), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    RgbdFrame& frame = pairs[i].first;
    frame.map_from_camera = MapFromCamera(turned(frame.map_from_camera.isometry(), roll));
  }
  EXPECT_FALSE(find_wrong_up(pairs, map_from_input_axis("y").value()));
}

}  // namespace
}  // namespace hypermap

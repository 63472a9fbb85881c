// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/dataset/up_axis.hpp"

#include "support/sanitized.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

/// A level rectangle, seen from above, with ripples of `noise_m`.
void add_level(std::vector<SurfacePoint>& points,
               double height_m,
               double side_m,
               double noise_m = 0.0) {
  constexpr double kStep = 0.05;
  int i = 0;
  for (double x = 0.0; x < side_m; x += kStep) {
    for (double y = 0.0; y < side_m; y += kStep) {
      const double ripple = noise_m * std::sin(1.7 * ++i);
      points.push_back({{x, y, height_m + ripple}, Eigen::Vector3d::UnitZ()});
    }
  }
}

/// A wall along x at y = 3.
void add_wall(std::vector<SurfacePoint>& points) {
  for (double x = 0.0; x < 4.0; x += 0.04) {
    for (double z = 0.0; z < 2.5; z += 0.04) {
      points.push_back({{x, 3.0, z}, -Eigen::Vector3d::UnitY()});
    }
  }
}

std::vector<SurfacePoint> turned(std::vector<SurfacePoint> points, const Eigen::Isometry3d& turn) {
  for (SurfacePoint& point : points) {
    point = {turn * point.position, turn.linear() * point.normal};
  }
  return points;
}

TEST(UpAxis, EachNamedAxisBecomesZ) {
  const std::pair<const char*, Eigen::Vector3d> cases[] = {{"x", {1, 0, 0}},
                                                           {"-x", {-1, 0, 0}},
                                                           {"y", {0, 1, 0}},
                                                           {"-y", {0, -1, 0}},
                                                           {"z", {0, 0, 1}},
                                                           {"-z", {0, 0, -1}}};
  for (const auto& [name, axis] : cases) {
    const auto turn = map_from_input_axis(name);
    ASSERT_TRUE(turn) << name;
    const Eigen::Matrix3d rotation = turn->isometry().linear();
    EXPECT_NEAR((rotation * axis - Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-12) << name;
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-12) << name;
    EXPECT_EQ(turn->origin().xyz, Eigen::Vector3d::Zero());
  }
  EXPECT_TRUE(map_from_input_axis("z")->isometry().linear().isIdentity(0.0));
  EXPECT_THAT(to_string(map_from_input_axis("up").error()), HasSubstr("must be one of x, -x"));
}

TEST(UpAxis, TheFloorIsFoundBelowALargerTableAndBesideAWall) {
  std::vector<SurfacePoint> room;
  add_level(room, -0.4, 1.5, 0.004);  // the floor: 900 points
  add_level(room, 0.35, 2.5, 0.004);  // a table top: 2500 points
  add_wall(room);
  // The world is turned by 25 degrees about x and the cameras look 20 degrees down.
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.linear() = Eigen::AngleAxisd(25.0 * std::numbers::pi / 180.0, Eigen::Vector3d::UnitX())
                      .toRotationMatrix();
  const Eigen::Vector3d camera_up =
      turn.linear() * Eigen::AngleAxisd(0.35, Eigen::Vector3d::UnitX()) * Eigen::Vector3d::UnitZ();
  const auto floor = find_floor(turned(room, turn), camera_up);
  ASSERT_TRUE(floor) << to_string(floor.error());
  EXPECT_NEAR((floor->up_in_input - turn.linear().col(2)).norm(), 0.0, 2e-3);
  const PointInMap on_floor =
      floor->map_from_input * Point<frame::Input>{turn * Eigen::Vector3d(0.7, 0.7, -0.4)};
  EXPECT_NEAR(on_floor.xyz.z(), 0.0, 0.006);
  EXPECT_NEAR(floor->tilt_from_camera_rad, 0.35, 5e-3);
  EXPECT_GT(floor->inlier_share, 0.09);
  EXPECT_THAT(to_string(*floor), HasSubstr("floor plane: normal ("));
}

TEST(UpAxis, AFewPointsBelowTheFloorDoNotCount) {
  std::vector<SurfacePoint> room;
  add_level(room, 0.0, 2.0, 0.003);
  for (int i = 0; i < 20; ++i) {  // reflections
    room.push_back({{0.05 * i, 0.0, -0.8}, Eigen::Vector3d::UnitZ()});
  }
  const auto floor = find_floor(room, Eigen::Vector3d::UnitZ());
  ASSERT_TRUE(floor) << to_string(floor.error());
  EXPECT_NEAR(floor->floor_height_m, 0.0, 0.005);
}

TEST(UpAxis, WithoutLevelSurfacesThereIsNoFloor) {
  std::vector<SurfacePoint> wall;
  add_wall(wall);
  const auto floor = find_floor(wall, Eigen::Vector3d::UnitZ());
  ASSERT_FALSE(floor);
  EXPECT_EQ(floor.error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(find_floor({}, Eigen::Vector3d::UnitZ()));
}

// --- data by others ---

constexpr const char* kAsInTheCabinet = "a sanitizer sees the same code in the cabinet's frames";

FloorEstimate floor_of(const std::string& folder, const DatasetOptions& options = {}) {
  ClassRegistry registry;
  const auto reader = open_dataset(test::shared_data(folder), options, registry);
  EXPECT_TRUE(reader) << to_string(reader.error());
  const auto floor = estimate_floor(**reader);
  EXPECT_TRUE(floor) << to_string(floor.error());
  return *floor;
}

TEST(UpAxis, TheCabinetsFloorIsWhereTheMotionCaptureSaysIt) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/tum_fr3_cabinet");
  const FloorEstimate floor =
      floor_of("rgbd/tum_fr3_cabinet",
               {.description = test::source_path("data/datasets/tum_fr3_cabinet.yaml")});
  EXPECT_GT(floor.up_in_input.z(), std::cos(0.035));  // 2 degrees
  EXPECT_NEAR(floor.floor_height_m, 0.0, 0.05);
}

TEST(UpAxis, TheKitchensYAxisPointsRoughlyDown) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/7scenes_redkitchen");
  if (test::kSanitized) GTEST_SKIP() << kAsInTheCabinet;
  const FloorEstimate floor = floor_of("rgbd/7scenes_redkitchen");
  EXPECT_LT(floor.up_in_input.y(), -0.8);
  // The camera is held at 1.2 to 1.6 m, and starts near the origin.
  EXPECT_NEAR(floor.floor_height_m, -1.5, 0.15);
}

TEST(UpAxis, TheLivingRoomsFloorIsLevel) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/icl_nuim_livingroom1");
  if (test::kSanitized) GTEST_SKIP() << kAsInTheCabinet;
  const FloorEstimate floor = floor_of("rgbd/icl_nuim_livingroom1");
  EXPECT_LT(floor.up_in_input.y(), -0.99);
  EXPECT_GT(floor.inlier_share, 0.1);
}

TEST(UpAxis, OptionsOutOfTheirRangeAreNamed) {
  const auto field = [](const FloorOptions& options) {
    const auto floor = find_floor({}, Eigen::Vector3d::UnitZ(), options);
    return floor.error().field;
  };
  EXPECT_EQ(field({.num_frames = 0}), "num_frames");
  EXPECT_EQ(field({.pixel_step = 0}), "pixel_step");
  EXPECT_EQ(field({.min_range_m = 0.0}), "min_range_m");
  EXPECT_EQ(field({.min_range_m = 4.5}), "max_range_m");
  EXPECT_EQ(field({.max_tilt_rad = 2.0}), "max_tilt_rad");
  EXPECT_EQ(field({.thickness_m = 0.0}), "thickness_m");
  EXPECT_EQ(field({.min_level_share = std::nan("")}), "min_level_share");
}

}  // namespace
}  // namespace hypermap

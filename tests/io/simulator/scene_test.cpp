// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/scene.hpp"

#include "hypermap/io/simulator/scene_file.hpp"
#include "support/sanitized.hpp"
#include "support/test_data.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>

namespace hypermap {
namespace {

Scene room() {
  Scene scene;
  scene.name = "room";
  scene.floor.outer = {{0, 0}, {6, 0}, {6, 5}, {0, 5}};
  scene.objects.push_back({.name = "desk",
                           .class_name = "table",
                           .shape = "table",
                           .position_m = {3.0, 2.0},
                           .yaw_rad = 0.5 * std::numbers::pi,
                           .size_m = {0.8, 1.6, 0.75}});
  scene.objects.push_back({.name = "mug",
                           .class_name = "cup",
                           .shape = "cup",
                           .on = "desk",
                           .position_m = {0.1, 0.5},
                           .size_m = {0.08, 0.08, 0.1}});
  return scene;
}

TEST(Scene, ThingsStandWhereTheSceneSays) {
  const auto furnished = furnish(room(), 0);
  ASSERT_TRUE(furnished) << to_string(furnished.error());
  ASSERT_EQ(furnished->objects.size(), 2U);
  const PlacedObject& desk = furnished->objects[0];
  EXPECT_EQ(desk.id, ObjectId{1});
  // Turned by 90 degrees: 1.6 m along x, 0.8 m along y.
  EXPECT_TRUE(desk.box.min_in_map.isApprox(Eigen::Vector3d(2.2, 1.6, 0.0), 1e-6));
  EXPECT_TRUE(desk.box.max_in_map.isApprox(Eigen::Vector3d(3.8, 2.4, 0.75), 1e-6));
  EXPECT_NEAR(area_m2(desk.footprint), 0.8 * 1.6, 1e-4);
  EXPECT_TRUE(desk.centroid_in_map.isApprox(Eigen::Vector3d(3.0, 2.0, 0.375), 1e-4));
}

TEST(Scene, AThingBesideAnotherStandsAtItsFootAndGoesWithIt) {
  Scene scene = room();
  scene.objects.push_back({.name = "seat",
                           .class_name = "chair",
                           .shape = "chair",
                           .beside = "desk",
                           .position_m = {0.6, 0.2},
                           .movable = false});
  for (const std::uint64_t seed : {0U, 5U}) {
    const auto furnished = furnish(scene, seed);
    ASSERT_TRUE(furnished) << to_string(furnished.error());
    const PlacedObject& desk = furnished->objects[0];
    const PlacedObject& seat = furnished->objects[2];
    // It has no jitter of its own: the pair moves as one.
    EXPECT_TRUE((desk.map_from_object.inverse() * seat.map_from_object)
                    .isApprox(Eigen::Isometry3d(Eigen::Translation3d(0.6, 0.2, 0.0)), 1e-9));
    EXPECT_NEAR(seat.box.min_in_map.z(), 0.0, 1e-6);
  }
  scene.objects[2].on = "desk";
  EXPECT_EQ(furnish(scene, 0).error().field, "beside");
  scene.objects[2].on.clear();
  scene.objects[2].beside = "shelf";
  EXPECT_EQ(furnish(scene, 0).error().code, ErrorCode::kNotFound);
}

TEST(Scene, AThingOnAnotherStandsOnItsTopInItsFrame) {
  const auto furnished = furnish(room(), 0);
  ASSERT_TRUE(furnished);
  const PlacedObject& mug = furnished->objects[1];
  // (0.1, 0.5) in the desk's frame, turned by 90 degrees: (-0.5, 0.1) in the map.
  EXPECT_NEAR(mug.map_from_object.translation().x(), 3.0 - 0.5, 1e-9);
  EXPECT_NEAR(mug.map_from_object.translation().y(), 2.0 + 0.1, 1e-9);
  EXPECT_NEAR(mug.box.min_in_map.z(), 0.75, 1e-6);
  EXPECT_NEAR(mug.box.max_in_map.z(), 0.85, 1e-6);
}

TEST(Scene, SeedsMoveThingsWithinTheJitterAndWhatStandsOnThemToo) {
  const Scene scene = room();
  const auto still = furnish(scene, 0);
  ASSERT_TRUE(still);
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const auto moved = furnish(scene, seed);
    ASSERT_TRUE(moved);
    const auto& [desk, mug] = std::tie(moved->objects[0], moved->objects[1]);
    const Eigen::Isometry3d change =
        still->objects[0].map_from_object.inverse() * desk.map_from_object;
    EXPECT_LE(change.translation().cwiseAbs().maxCoeff(), scene.position_jitter_m * 1.4143);
    EXPECT_LE(std::abs(Eigen::AngleAxisd(change.linear()).angle()), scene.yaw_jitter_rad + 1e-12);
    EXPECT_GT(change.translation().norm(), 0.0);
    const Eigen::Vector3d on_desk =
        (desk.map_from_object.inverse() * mug.map_from_object).translation();
    EXPECT_LE(std::abs(on_desk.x() - 0.1), 0.4 * scene.position_jitter_m + 1e-12);
    EXPECT_LE(std::abs(on_desk.y() - 0.5), 0.4 * scene.position_jitter_m + 1e-12);
  }
}

TEST(Scene, FixedThingsStayAndTheSameSeedGivesTheSameRoom) {
  Scene scene = room();
  scene.objects[0].movable = false;
  const auto a = furnish(scene, 7);
  const auto b = furnish(scene, 7);
  ASSERT_TRUE(a && b);
  EXPECT_NEAR(a->objects[0].map_from_object.translation().x(), 3.0, 1e-15);
  EXPECT_EQ(a->objects[1].mesh.vertices, b->objects[1].mesh.vertices);
  const auto other = furnish(scene, 8);
  ASSERT_TRUE(other);
  EXPECT_NE(a->objects[1].mesh.vertices, other->objects[1].mesh.vertices);
}

TEST(Scene, SupportsThatComeLaterOrNeverAreRefused) {
  Scene scene = room();
  std::swap(scene.objects[0], scene.objects[1]);
  const auto furnished = furnish(scene, 0);
  ASSERT_FALSE(furnished);
  EXPECT_EQ(furnished.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(furnished.error().entry, "mug");
  EXPECT_EQ(furnished.error().field, "on");
}

TEST(Scene, TwoThingsOfOneNameAreRefused) {
  Scene scene = room();
  scene.objects[1].name = "desk";
  scene.objects[1].on = "";
  const auto furnished = furnish(scene, 0);
  ASSERT_FALSE(furnished);
  EXPECT_EQ(furnished.error().field, "name");
}

TEST(Scene, AnUnknownShapeNamesTheThing) {
  Scene scene = room();
  scene.objects[0].shape = "piano";
  const auto furnished = furnish(scene, 0);
  ASSERT_FALSE(furnished);
  EXPECT_EQ(furnished.error().entry, "desk");
  EXPECT_EQ(furnished.error().field, "shape");
}

TEST(Scene, WithoutLightsThereIsOneInTheMiddle) {
  const auto furnished = furnish(room(), 0);
  ASSERT_TRUE(furnished);
  ASSERT_EQ(furnished->lights_in_map.size(), 1U);
  EXPECT_TRUE(furnished->lights_in_map[0].isApprox(Eigen::Vector3d(3.0, 2.5, 2.6), 1e-12));
}

void expect_apart(const std::vector<PlacedObject>& objects, std::uint64_t seed) {
  for (const PlacedObject& a : objects) {
    for (const PlacedObject& b : objects) {
      if (!(a.id < b.id) || !a.box.intersects(b.box)) continue;
      const bool stacked = a.box.max_in_map.z() <= b.box.min_in_map.z() + 1e-6;
      EXPECT_TRUE(stacked || !intersects(a.footprint, b.footprint))
          << a.name << " " << b.name << " seed " << seed;
    }
  }
}

/// Whatever the seed: objects that stand on the floor keep clear of each other, and the camera
/// keeps clear of all that is as high as it.
TEST(Scene, InTheScenesThatShipNothingCollides) {
  const std::filesystem::path scenes = test::source_path("data/scenes");
  for (const char* name : {"laboratory.yaml", "floor.yaml"}) {
    const auto scene = load_scene(scenes / name);
    ASSERT_TRUE(scene) << to_string(scene.error());
    const auto path = CameraPath::create(scene->waypoints, scene->path);
    ASSERT_TRUE(path);
    constexpr std::array<std::uint64_t, 7> kSeeds{0, 1, 2, 3, 101, 105, 110};
    for (const std::uint64_t seed : std::span(kSeeds).first(test::repetitions(kSeeds.size()))) {
      const auto furnished = furnish(*scene, seed);
      ASSERT_TRUE(furnished) << to_string(furnished.error());
      for (const PlacedObject& a : furnished->objects) {
        for (const Eigen::Vector2d& corner : a.footprint.outer)
          EXPECT_TRUE(contains(scene->floor, corner)) << a.name << " seed " << seed;
      }
      expect_apart(furnished->objects, seed);
      for (double t = 0.0; t <= path->duration_s(); t += 0.25) {
        const Eigen::Vector3d camera = path->pose_at(t).origin().xyz;
        for (const PlacedObject& object : furnished->objects) {
          const bool robot_hits = contains(object.footprint, Eigen::Vector2d(camera.head<2>()));
          EXPECT_FALSE(robot_hits) << object.name << " at " << t << " s, seed " << seed;
        }
      }
    }
  }
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
// The scenes in data/scenes: nothing in the camera's way, nothing that it never sees.
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "io/simulator/room_simulation.hpp"
#include "support/sanitized.hpp"
#include "support/test_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

class ShippedScene : public testing::TestWithParam<const char*> {
 protected:
  static Scene load() {
    auto scene = load_scene(test::source_path("data/scenes/" + std::string(GetParam()) + ".yaml"));
    EXPECT_TRUE(scene) << to_string(scene.error());
    return scene ? *std::move(scene) : Scene{};
  }
};

TEST_P(ShippedScene, IsReadAndFurnished) {
  const Scene scene = load();
  EXPECT_EQ(scene.name, GetParam());
  EXPECT_GE(scene.objects.size(), scene.name == "pillars" ? 8U : 20U);
  const auto furnished = furnish(scene, 1);
  EXPECT_TRUE(furnished) << to_string(furnished.error());
}

TEST_P(ShippedScene, TheCameraAndThoseWhoWalkGoFree) {
  const Scene scene = load();
  const auto path = CameraPath::create(scene.waypoints, scene.path);
  ASSERT_TRUE(path) << to_string(path.error());
  std::vector<Eigen::Vector2d> eyes;
  for (int i = 0; i <= 400; ++i)
    eyes.emplace_back(path->pose_at(path->duration_s() * i / 400).origin().xyz.head<2>());
  for (const std::uint64_t seed : {0U, 1U, 2U, 101U}) {
    const auto furnished = furnish(scene, seed);
    ASSERT_TRUE(furnished) << to_string(furnished.error());
    for (const PlacedObject& object : furnished->objects) {
      for (const Eigen::Vector2d& eye : eyes) {
        EXPECT_TRUE(contains(scene.floor, eye)) << eye.transpose();
        ASSERT_GE(distance_m(object.footprint, eye), 0.1)
            << object.name << " at " << eye.transpose();
      }
      // Nothing stands in a wall.
      for (const Eigen::Vector2d& corner : object.footprint.outer)
        EXPECT_TRUE(contains(scene.floor, corner)) << object.name << " " << corner;
      for (const MovingBody& body : scene.moving) {
        for (const Eigen::Vector2d& point : body.way_in_map)
          EXPECT_GE(distance_m(object.footprint, point), 0.25) << object.name << " " << body.name;
      }
    }
  }
  for (const MovingBody& body : scene.moving) {
    for (const Eigen::Vector2d& point : body.way_in_map) {
      for (const Eigen::Vector2d& eye : eyes) ASSERT_GE((eye - point).norm(), 0.6) << body.name;
    }
  }
}

/// Things on others do not hang in the air: their middle lies within what bears them.
TEST_P(ShippedScene, ThingsStandOnWhatBearsThem) {
  const Scene scene = load();
  const auto furnished = furnish(scene, 101);
  ASSERT_TRUE(furnished);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (scene.objects[i].on.empty()) continue;
    const auto bearer =
        std::ranges::find(furnished->objects, scene.objects[i].on, &PlacedObject::name);
    ASSERT_NE(bearer, furnished->objects.end());
    const PlacedObject& object = furnished->objects[i];
    EXPECT_TRUE(contains(bearer->footprint, object.centroid_in_map.head<2>())) << object.name;
  }
}

/// Of what the detector can name, nine in ten are seen well enough to count.
TEST_P(ShippedScene, ShowsWhatItHolds) {
  SimulationOptions options;
  options.num_frames = test::kSanitized ? 30 : 60;
  options.camera = {160, 120, 131.25, 131.25, 79.5, 59.5};  // a sixteenth of the usual pixels
  const auto simulator = Simulator::create(load(), options);
  ASSERT_TRUE(simulator) << to_string(simulator.error());
  std::vector<int> best(simulator->objects().size(), 0);
  for (std::size_t i = 0; i < simulator->size(); ++i) {
    const SimulatedFrame simulated = simulator->render(i);
    std::ranges::transform(
        best, simulated.depth_pixels, best.begin(), [](int a, int b) { return std::max(a, b); });
  }
  int nameable = 0;
  int seen = 0;
  std::string unseen;
  for (const PlacedObject& object : simulator->objects()) {
    if (!simulator->detector().knows_class(object.class_name)) continue;
    ++nameable;
    const bool is_seen = best[object.id.value - 1] >= 200 / 16;
    seen += is_seen ? 1 : 0;
    if (!is_seen) unseen.append(" ").append(object.name);
  }
  EXPECT_GE(seen, nameable * 9 / 10) << unseen;
}

INSTANTIATE_TEST_SUITE_P(All,
                         ShippedScene,
                         testing::Values("apartment",
                                         "cafe",
                                         "classroom",
                                         "flat",
                                         "floor",
                                         "hall",
                                         "laboratory",
                                         "lounge",
                                         "office",
                                         "pillars",
                                         "reading_room",
                                         "store_room",
                                         "studio",
                                         "ward",
                                         "workshop"),
                         [](const auto& scene) { return std::string(scene.param); });

/// In the last third of its way the camera sees what stands free, and next to nothing of what the
/// pillars hide.
TEST(ShippedPillars, HideFourThingsInTheEnd) {
  const std::vector<std::string> hidden{"chair_1", "backpack", "suitcase", "plant"};
  SimulationOptions options;
  options.num_frames = 30;
  options.camera = {160, 120, 131.25, 131.25, 79.5, 59.5};
  for (const std::uint64_t seed : {0U, 1U, 101U}) {
    options.seed = seed;
    const auto simulator = Simulator::create(
        load_scene(test::source_path("data/scenes/pillars.yaml")).value(), options);
    ASSERT_TRUE(simulator) << to_string(simulator.error());
    std::vector<int> before(simulator->objects().size(), 0);
    std::vector<int> in_the_end = before;
    for (std::size_t i = 0; i < simulator->size(); ++i) {
      std::vector<int>& most = 3 * i < 2 * simulator->size() ? before : in_the_end;
      std::ranges::transform(
          simulator->render(i).depth_pixels, most, most.begin(), [](int a, int b) {
            return std::max(a, b);
          });
    }
    for (const PlacedObject& object : simulator->objects()) {
      const std::size_t at = object.id.value - 1;
      EXPECT_GE(before[at], 200 / 16) << object.name;
      if (std::ranges::find(hidden, object.name) != hidden.end()) {
        EXPECT_LE(in_the_end[at], before[at] / 20) << object.name << ", seed " << seed;
      }
      if (object.name == "refrigerator") {
        EXPECT_GE(in_the_end[at], 200 / 16);
      }
    }
  }
}

/// The camera's way shows every nameable object of the laboratory well enough to count.
TEST(ShippedLaboratory, TheLaboratoryShowsAllThatItHolds) {
  const auto scene = load_scene(test::source_path("data/scenes/laboratory.yaml"));
  ASSERT_TRUE(scene) << to_string(scene.error());
  SimulationOptions options;
  options.num_frames = 40;
  // An image of a sixteenth of the pixels where a sanitizer makes rays dear.
  if (test::kSanitized) options.camera = test::kSmall;
  const int enough_px = test::kSanitized ? 200 / 16 : 200;
  const auto simulator = Simulator::create(*scene, options);
  ASSERT_TRUE(simulator);
  std::vector<int> best(simulator->objects().size(), 0);
  for (std::size_t i = 0; i < simulator->size(); ++i) {
    const SimulatedFrame simulated = simulator->render(i);
    std::ranges::transform(
        best, simulated.depth_pixels, best.begin(), [](int a, int b) { return std::max(a, b); });
  }
  for (std::size_t i = 0; i < best.size(); ++i)
    EXPECT_GE(best[i], enough_px) << simulator->objects()[i].name;
}

}  // namespace
}  // namespace hypermap

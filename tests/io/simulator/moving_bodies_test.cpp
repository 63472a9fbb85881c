// SPDX-License-Identifier: BSD-3-Clause
// Bodies that go to and fro: in frames, and in no truth.
#include "hypermap/io/simulator/furniture.hpp"
#include "hypermap/io/simulator/scene_renderer.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "io/simulator/room_simulation.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace hypermap {
namespace {

using test::room_scene;
using test::small_options;

Scene walked_room(double speed_m_per_s = 0.5) {
  Scene scene = room_scene();
  scene.moving.push_back({.name = "walker",
                          .class_name = "person",
                          .shape = "person",
                          .way_in_map = {{2.0, 0.8}, {2.0, 3.4}},
                          .speed_m_per_s = speed_m_per_s});
  return scene;
}

const ObjectId kWalker{6};  // behind the five things of the room

/// Middle of what the pixels of an object measure, in the map.
Eigen::Vector3d middle_of(const SimulatedFrame& simulated, ObjectId id) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (int v = 0; v < test::kSmall.height_px; ++v) {
    for (int u = 0; u < test::kSmall.width_px; ++u) {
      const double depth = static_cast<double>(simulated.frame.depth_m.at(u, v));
      if (simulated.instances.at(u, v) != id || depth == 0.0) continue;
      sum += (simulated.true_pose * test::kSmall.unproject(u, v, depth)).xyz;
      ++count;
    }
  }
  return count == 0 ? Eigen::Vector3d::Zero() : Eigen::Vector3d(sum / count);
}

TEST(MovingBodies, AFrameShowsThemWhereTheyAreAtThatTime) {
  SimulationOptions options = small_options();
  options.seed = 0;  // they begin at the first point
  const auto simulator = Simulator::create(walked_room(), options);
  ASSERT_TRUE(simulator) << to_string(simulator.error());
  int seen = 0;
  for (std::size_t i = 0; i < simulator->size(); ++i) {
    const SimulatedFrame simulated = simulator->render(i);
    const double gone = std::fmod(0.5e-9 * static_cast<double>(simulated.frame.stamp.ns), 5.2);
    const double y = 0.8 + (gone <= 2.6 ? gone : 5.2 - gone);
    const Eigen::Vector3d middle = middle_of(simulated, kWalker);
    if (middle.isZero()) continue;
    EXPECT_NEAR(middle.x(), 2.0, 0.35) << i;
    EXPECT_NEAR(middle.y(), y, 0.35) << i;
    ++seen;
  }
  EXPECT_GE(seen, 3);
}

TEST(MovingBodies, TheyAreDetectedAndInNoTruth) {
  const test::TempDir dir;
  SimulationOptions options = small_options();
  options.detector.noisy = false;
  const auto simulator = Simulator::create(walked_room(), options);
  ASSERT_TRUE(simulator);
  EXPECT_EQ(simulator->objects().size(), 5U);
  const auto person = simulator->classes().find("person");
  ASSERT_TRUE(person);
  int named = 0;
  for (std::size_t i = 0; i < simulator->size(); ++i) {
    const SimulatedFrame simulated = simulator->render(i);
    EXPECT_EQ(simulated.depth_pixels.size(), 5U);
    for (const Detection& detection : simulated.frame.detections)
      named += best_class(detection.class_scores)->id == *person ? 1 : 0;
  }
  EXPECT_GT(named, 0);
  const auto report = simulate(walked_room(), options, dir / "out");
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->objects.size(), 5U);
}

TEST(MovingBodies, ABodyLooksLikeAnObjectInItsPlace) {
  FurnishedScene empty;
  empty.room = MeshBuilder().box({4, -50, -50}, {5, 50, 50}).build();
  empty.lights_in_map = {{1, 1, 2}};
  const auto mesh = build_furniture({"person", Eigen::Vector3d::Zero(), {}});
  ASSERT_TRUE(mesh) << to_string(mesh.error());
  const Eigen::Isometry3d place =
      Eigen::Translation3d(2.5, 0.2, 0.0) * Eigen::AngleAxisd(0.8, Eigen::Vector3d::UnitZ());
  FurnishedScene furnished = empty;
  PlacedObject object;
  object.id = ObjectId{1};
  object.mesh = transformed(*mesh, place);
  object.map_from_object = place;
  furnished.objects.push_back(object);
  const auto fixed = SceneRenderer::create(furnished);
  const auto moving = SceneRenderer::create(empty, std::array{*mesh});
  ASSERT_TRUE(fixed && moving);
  const MapFromCamera pose = look_at({0, 0, 1.2}, {2.5, 0, 0.9});
  const RenderedView as_object = fixed->render(test::kSmall, pose);
  const RenderedView as_body = moving->render(test::kSmall, pose, std::array{place});
  int different = 0;
  int on_it = 0;
  for (std::size_t i = 0; i < as_object.instances.size(); ++i) {
    const ObjectId id = as_object.instances.pixels()[i];
    on_it += id == ObjectId{1} ? 1 : 0;
    if (as_body.instances.pixels()[i] != id) {  // at an edge
      ++different;
      continue;
    }
    EXPECT_NEAR(as_body.depth_m.pixels()[i], as_object.depth_m.pixels()[i], 2e-3F);
    const int brighter = as_body.color.pixels()[i].g - as_object.color.pixels()[i].g;
    different += std::abs(brighter) > 12 ? 1 : 0;  // at the edge of a shadow
  }
  EXPECT_GT(on_it, 1000);
  EXPECT_LT(different, on_it / 50);
  const auto share = moving->unhidden_shares(
      as_body, std::array{ObjectId{1}}, test::kSmall, pose, std::array{place});
  EXPECT_NEAR(share.at(0),
              fixed->unhidden_shares(as_object, std::array{ObjectId{1}}, test::kSmall, pose)[0],
              0.02);
  EXPECT_GT(share.at(0), 0.5);
}

TEST(MovingBodies, NearerThingsHideThemAndTheyHideWhatIsBehind) {
  FurnishedScene scene;
  scene.room = MeshBuilder().box({4, -50, -50}, {5, 50, 50}).build();
  scene.lights_in_map = {{0, 0, 2}};
  PlacedObject screen;
  screen.id = ObjectId{1};
  screen.mesh = MeshBuilder().box({2.0, -3, -3}, {2.1, 0, 3}).build();  // hides y < 0
  scene.objects.push_back(screen);
  const TriangleMesh ball = MeshBuilder().ellipsoid({0, 0, 0}, {0.3, 0.3, 0.3}).build();
  const auto renderer = SceneRenderer::create(scene, std::array{ball});
  ASSERT_TRUE(renderer);
  const MapFromCamera pose = look_at({0, 0, 0}, {1, 0, 0});
  const auto pixels_at = [&](double x) {
    const Eigen::Isometry3d place(Eigen::Translation3d(x, 0.0, 0.0));
    const RenderedView view = renderer->render(test::kSmall, pose, std::array{place});
    return std::array{std::ranges::count(view.instances.pixels(), ObjectId{2}),
                      std::ranges::count(view.instances.pixels(), ObjectId{1})};
  };
  const auto [behind, screen_alone] = pixels_at(3.0);
  const auto [before, screen_hidden] = pixels_at(1.0);
  EXPECT_GT(behind, 100);  // half of the ball
  EXPECT_GT(before, 10 * behind);
  EXPECT_LT(screen_hidden, screen_alone);
}

TEST(MovingBodies, SeedsBeginElsewhereAndThreadsDoNotMatter) {
  const test::TempDir dir;
  SimulationOptions options = small_options();
  options.num_threads = 1;
  ASSERT_TRUE(simulate(walked_room(), options, dir / "one"));
  options.num_threads = 3;
  ASSERT_TRUE(simulate(walked_room(), options, dir / "three"));
  EXPECT_EQ(test::files_below(dir / "one"), test::files_below(dir / "three"));
  const auto a = Simulator::create(walked_room(), options);
  options.seed = 2;
  const auto b = Simulator::create(walked_room(), options);
  ASSERT_TRUE(a && b);
  EXPECT_NE(a->render(2).instances, b->render(2).instances);
}

TEST(MovingBodies, WaysThatAreNoneAreRefused) {
  for (const double speed : {0.0, -1.0}) {
    const auto refused = Simulator::create(walked_room(speed), small_options());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().field, "speed");
    EXPECT_EQ(refused.error().entry, "walker");
  }
  Scene scene = walked_room();
  scene.moving[0].way_in_map.pop_back();
  EXPECT_EQ(Simulator::create(scene, small_options()).error().field, "way");
  scene = walked_room();
  scene.moving[0].shape = "ghost";
  EXPECT_EQ(Simulator::create(scene, small_options()).error().field, "shape");
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
// Things that are moved, removed and added between two passes.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulator.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"
#include "hypermap/projection/layers/semantic_layer.hpp"
#include "io/simulator/room_simulation.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>

namespace hypermap {
namespace {

using test::room_scene;
using test::small_options;
using testing::HasSubstr;

/// A room with a table that nobody can name, and seven things that can change.
Scene busy_room() {
  Scene scene = room_scene();
  scene.objects.push_back(
      {.name = "bag", .class_name = "backpack", .shape = "backpack", .position_m = {1.9, 3.4}});
  scene.objects.push_back(
      {.name = "case", .class_name = "suitcase", .shape = "suitcase", .position_m = {2.6, 3.4}});
  scene.objects.push_back(
      {.name = "seat", .class_name = "chair", .shape = "chair", .position_m = {2.0, 0.5}});
  return scene;
}

SimulationOptions changing_options() {
  SimulationOptions options = small_options();
  options.num_passes = 2;
  options.changes = {.num_moved = 2, .num_removed = 1, .num_added = 1};
  return options;
}

bool shows(const SimulatedFrame& simulated, ObjectId id) {
  const auto pixels = simulated.instances.pixels();
  return std::ranges::find(pixels, id) != pixels.end();
}

TEST(SimulatedChanges, TheTruthIsTheStateAtTheEnd) {
  const auto simulator = Simulator::create(busy_room(), changing_options());
  ASSERT_TRUE(simulator) << to_string(simulator.error());
  ASSERT_EQ(simulator->changes().size(), 4U);
  EXPECT_EQ(simulator->objects().size(), 8U - 1U);
  for (std::size_t i = 0; i < simulator->objects().size(); ++i)
    EXPECT_EQ(simulator->objects()[i].id.value, i + 1);
  std::multiset<int> kinds;
  for (const SceneChange& change : simulator->changes()) {
    kinds.insert(static_cast<int>(change.kind));
    const auto now =
        std::ranges::find(simulator->objects(), change.object.name, &PlacedObject::name);
    if (change.kind == SceneChange::Kind::kRemoved) {
      EXPECT_EQ(now, simulator->objects().end()) << change.object.name;
      EXPECT_EQ(change.at_end, kNoObject);
      continue;
    }
    ASSERT_NE(now, simulator->objects().end());
    EXPECT_EQ(change.at_end, now->id);
    if (change.kind == SceneChange::Kind::kMoved) {
      EXPECT_GE((now->centroid_in_map - change.object.centroid_in_map).norm(), 0.6);
      EXPECT_NEAR(now->box.min_in_map.z(), 0.0, 1e-5);
    }
  }
  EXPECT_EQ(kinds, (std::multiset<int>{0, 0, 1, 2}));
}

TEST(SimulatedChanges, MovedThingsStandFree) {
  const Scene scene = busy_room();
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    SimulationOptions options = changing_options();
    options.seed = seed;
    const auto simulator = Simulator::create(scene, options);
    ASSERT_TRUE(simulator) << to_string(simulator.error());
    for (const SceneChange& change : simulator->changes()) {
      if (change.kind != SceneChange::Kind::kMoved) continue;
      const PlacedObject& moved = simulator->objects()[change.at_end.value - 1];
      EXPECT_FALSE(moved.box.intersects(change.object.box));
      for (const PlacedObject& other : simulator->objects())
        EXPECT_TRUE(other.id == moved.id || !other.box.intersects(moved.box)) << other.name;
      for (const Eigen::Vector3d& corner : moved.box.corners())
        EXPECT_TRUE(contains(scene.floor, corner.head<2>()));
    }
  }
}

TEST(SimulatedChanges, FramesShowEachStateInItsPassAlone) {
  const auto simulator = Simulator::create(busy_room(), changing_options());
  ASSERT_TRUE(simulator);
  int seen_before = 0;
  for (std::size_t i = 0; i < simulator->size(); ++i) {
    const bool last_pass = i >= 6;
    const SimulatedFrame simulated = simulator->render(i);
    EXPECT_EQ(simulated.depth_pixels.size(), simulator->objects().size());
    for (const SceneChange& change : simulator->changes()) {
      const bool is_added = change.kind == SceneChange::Kind::kAdded;
      if (last_pass) {
        EXPECT_TRUE(is_added || !shows(simulated, change.object.id)) << change.object.name;
      } else {
        EXPECT_TRUE(change.at_end == kNoObject || !shows(simulated, change.at_end))
            << change.object.name;
        seen_before += !is_added && shows(simulated, change.object.id) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(seen_before, 0);
}

TEST(SimulatedChanges, TheTruthTellsWhatChanged) {
  const test::TempDir dir;
  const auto report = simulate(busy_room(), changing_options(), dir / "out");
  ASSERT_TRUE(report) << to_string(report.error());
  EXPECT_EQ(report->objects.size(), 7U);
  const auto loaded = load_archive(dir / "out/truth.hmap");
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  for (const Finding& finding : loaded->findings) ADD_FAILURE() << to_string(finding.error);
  const auto layer = loaded->value.hypermap.at("changes");
  ASSERT_TRUE(layer) << to_string(layer.error());
  const auto* changes = (*layer)->content.as<SemanticLayer>();
  ASSERT_NE(changes, nullptr);
  ASSERT_EQ(changes->objects().size(), 4U);
  const auto simulator = Simulator::create(busy_room(), changing_options());
  ASSERT_TRUE(simulator);
  constexpr std::array<std::string_view, 3> kNames{"moved", "removed", "added"};
  for (std::size_t i = 0; i < 4; ++i) {
    const SemanticObject& entry = changes->objects()[i];
    const SceneChange& change = simulator->changes()[i];
    EXPECT_EQ(entry.name, change.object.class_name);
    EXPECT_NEAR((position_of(entry) - change.object.centroid_in_map.head<2>()).norm(), 0.0, 1e-3);
    EXPECT_EQ(entry.extra.find("change")->text, kNames[static_cast<std::size_t>(change.kind)]);
    EXPECT_EQ(entry.extra.find("thing")->text, change.object.name);
    EXPECT_EQ(entry.extra.find("at_end") == nullptr, change.at_end == kNoObject);
  }
}

TEST(SimulatedChanges, WithoutAnyTheTruthHasNoSuchLayer) {
  const test::TempDir dir;
  ASSERT_TRUE(simulate(room_scene(), small_options(), dir / "out"));
  const auto loaded = load_archive(dir / "out/truth.hmap");
  ASSERT_TRUE(loaded);
  EXPECT_FALSE(loaded->value.hypermap.at("changes"));
}

TEST(SimulatedChanges, WhatBearsOthersIsFixedOrHasNoWordStays) {
  Scene scene = busy_room();
  scene.objects[2].movable = false;  // the chair
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U}) {
    SimulationOptions options = changing_options();
    options.seed = seed;
    const auto simulator = Simulator::create(scene, options);
    ASSERT_TRUE(simulator) << to_string(simulator.error());
    for (const SceneChange& change : simulator->changes())
      EXPECT_THAT(change.object.name, testing::AnyOf("screen", "mug", "bag", "case", "seat"));
  }
}

TEST(SimulatedChanges, MoreThanASceneCanGiveIsRefused) {
  SimulationOptions options = changing_options();
  options.changes = {.num_removed = 50};
  const auto refused = Simulator::create(busy_room(), options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().field, "changes.num_removed");
  EXPECT_THAT(refused.error().what, HasSubstr("at most 6"));
  options.changes = {.num_moved = 50};
  EXPECT_EQ(Simulator::create(busy_room(), options).error().field, "changes.num_moved");
}

TEST(SimulatedChanges, AnyNumberOfThreadsGivesTheSameBytes) {
  const test::TempDir dir;
  SimulationOptions options = changing_options();
  options.num_threads = 1;
  ASSERT_TRUE(simulate(busy_room(), options, dir / "one"));
  options.num_threads = 3;
  ASSERT_TRUE(simulate(busy_room(), options, dir / "three"));
  EXPECT_EQ(test::files_below(dir / "one"), test::files_below(dir / "three"));
}

}  // namespace
}  // namespace hypermap

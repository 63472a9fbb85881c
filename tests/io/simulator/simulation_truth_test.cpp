// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulation_truth.hpp"

#include "hypermap/projection/layers/evaluated_objects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hypermap {
namespace {

/// A room of 2 m by 1 m with a pillar of 0.2 m by 0.2 m and a shelf above the band.
FurnishedScene pillar_room() {
  FurnishedScene scene;
  MeshBuilder room;
  room.box({0, 0, -0.01}, {2, 1, 0.0});    // the floor, below the band
  room.box({-0.05, 0, 0}, {0.0, 1, 2.5});  // walls of one cell
  room.box({2.0, 0, 0}, {2.05, 1, 2.5});
  room.box({0, -0.05, 0}, {2, 0.0, 2.5});
  room.box({0, 1.0, 0}, {2, 1.05, 2.5});
  room.box({1.0, 0.4, 0}, {1.2, 0.6, 2.5});
  room.box({0.2, 0.2, 2.0}, {0.4, 0.4, 2.1});
  scene.room = room.build();
  return scene;
}

const std::vector<CameraWaypoint> kWay{{{0.5, 0.5, 1.4}, {1.0, 0.5, 1.0}}};

TEST(SimulationTruth, OccupancyHasWallsAndThingsAndWhatCanBeReached) {
  const auto grid = true_occupancy(pillar_room(), kWay);
  ASSERT_TRUE(grid) << to_string(grid.error());
  EXPECT_EQ(grid->at_point({0.5, 0.5}), kFreeCell);
  EXPECT_EQ(grid->at_point({1.7, 0.5}), kFreeCell);
  EXPECT_EQ(grid->at_point({-0.025, 0.5}), kOccupiedCell);
  EXPECT_EQ(grid->at_point({0.3, 0.3}), kFreeCell);  // under the shelf
  EXPECT_EQ(grid->at_point({1.025, 0.5}), kOccupiedCell);
  EXPECT_EQ(grid->at_point({1.1, 0.5}), kUnknownCell);    // inside the pillar
  EXPECT_EQ(grid->at_point({-0.12, 0.5}), kUnknownCell);  // behind the wall
  // Faces at 1.0 and 1.2 lie in the cells from there on: 5 x 5 cells less the inner 3 x 3.
  int occupied = 0;
  for (double x = 0.925; x < 1.3; x += 0.05) {
    for (double y = 0.325; y < 0.7; y += 0.05)
      occupied += grid->at_point({x, y}) == kOccupiedCell ? 1 : 0;
  }
  EXPECT_EQ(occupied, 16);
}

TEST(SimulationTruth, SurfacesAreCutAtTheBand) {
  FurnishedScene scene = pillar_room();
  // A ramp from z = 0 at x = 1.4 to z = 0.4 at x = 1.8: inside the band from x = 1.5 on.
  MeshBuilder ramp;
  const std::array<Eigen::Vector3d, 4> corners{Eigen::Vector3d(1.4, 0.1, 0.0),
                                               Eigen::Vector3d(1.8, 0.1, 0.4),
                                               Eigen::Vector3d(1.8, 0.3, 0.4),
                                               Eigen::Vector3d(1.4, 0.3, 0.0)};
  scene.objects.push_back({.id = ObjectId{1}, .mesh = ramp.sheet(corners).build()});
  const auto grid = true_occupancy(scene, kWay);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->at_point({1.475, 0.2}), kFreeCell);
  EXPECT_EQ(grid->at_point({1.525, 0.2}), kOccupiedCell);
  EXPECT_EQ(grid->at_point({1.775, 0.2}), kOccupiedCell);
  EXPECT_EQ(grid->at_point({1.875, 0.2}), kFreeCell);
}

TEST(SimulationTruth, BadBandsAreRefused) {
  EXPECT_EQ(true_occupancy(pillar_room(), kWay, {.min_height_m = 2.0}).error().field,
            "max_height_m");
  EXPECT_EQ(true_occupancy(pillar_room(), kWay, {.resolution_m = 0.0}).error().field,
            "resolution_m");
}

Scene small_room() {
  Scene scene;
  scene.name = "room";
  scene.floor.outer = {{0, 0}, {5, 0}, {5, 4}, {0, 4}};
  scene.objects = {
      {.name = "bench", .class_name = "bench", .shape = "bench", .position_m = {3.5, 2.0}},
      {.name = "bin", .class_name = "bin", .shape = "bin", .position_m = {4.5, 0.5}}};
  scene.waypoints = {{{0.5, 1.0, 1.4}, {3.5, 2.0, 0.6}}, {{0.8, 3.0, 1.4}, {3.5, 1.8, 0.6}}};
  return scene;
}

TEST(SimulationTruth, TheArchiveHoldsFootprintsBoxesAndReasons) {
  const Scene scene = small_room();
  const auto simulator = Simulator::create(scene, {.num_frames = 1});
  ASSERT_TRUE(simulator);
  std::vector<SimulatedTruth> truths{{"bench", "bench", 5000, 4, "", 3},
                                     {"bin", "bin", 900, 1, ""}};
  for (SimulatedTruth& truth : truths)
    truth.exclusion_reason = exclusion(truth, simulator->detector());
  TrueSurfaces surfaces{
      .objects = {{.id = ObjectId{1}, .class_name = "bench", .seen_cells = {{60, 40, 9}}},
                  {.id = ObjectId{2}, .class_name = "bin", .is_nameable = false}}};
  const auto archive = make_truth(*simulator, scene, truths, surfaces);
  ASSERT_TRUE(archive) << to_string(archive.error());
  const auto layer = archive->hypermap.at("semantic");
  ASSERT_TRUE(layer);
  const auto& semantic = *(*layer)->content.as<SemanticLayer>();
  ASSERT_EQ(semantic.objects().size(), 2U);
  const PlacedObject& bench = simulator->objects()[0];
  EXPECT_EQ(semantic.objects()[0].id, 1U);
  EXPECT_EQ(semantic.objects()[0].name, "bench");
  EXPECT_EQ(semantic.objects()[0].parts.at(0), bench.footprint);
  ASSERT_EQ(archive->objects.size(), 2U);
  EXPECT_EQ(archive->objects.at(ObjectId{1}).box, bench.box);
  EXPECT_EQ(archive->objects.at(ObjectId{1}).centroid_in_map, bench.centroid_in_map);
  ASSERT_TRUE(archive->hypermap.at("occupancy"));
  EXPECT_EQ(archive->true_surfaces, surfaces);

  const auto evaluated = evaluated_objects(semantic);
  ASSERT_EQ(evaluated.size(), 2U);
  EXPECT_FALSE(evaluated[0].excluded);
  EXPECT_TRUE(evaluated[1].excluded);
  EXPECT_NEAR(evaluated[0].size_m, bench.box.extent().maxCoeff(), 1e-12);
  EXPECT_TRUE(evaluated[0].centroid.isApprox(bench.centroid_in_map.head<2>(), 1e-12));
  EXPECT_EQ(evaluated[0].box, bench.box);
  EXPECT_EQ(evaluated[0].frames_named, 3U);
  EXPECT_EQ(evaluated[1].frames_named, 0U);
  EXPECT_TRUE(evaluated[0].is_nameable);
  EXPECT_FALSE(evaluated[1].is_nameable);
  EXPECT_EQ(evaluated[1].seen_footprint_share, 0.0);
}

TEST(SimulationTruth, ThingsRarelySeenDoNotCount) {
  const auto simulator = Simulator::create(small_room(), {.num_frames = 1});
  ASSERT_TRUE(simulator);
  const auto reason = [&](const char* name, int pixels, std::size_t frames_named) {
    return exclusion({name, name, pixels, 9, "", frames_named}, simulator->detector());
  };
  EXPECT_EQ(reason("bench", 200, 3), "");
  EXPECT_THAT(reason("bench", 199, 3), testing::HasSubstr("199"));
  EXPECT_THAT(reason("bench", 5000, 2), testing::HasSubstr("rarely seen: named rightly in 2"));
  EXPECT_THAT(reason("bin", 5000, 3), testing::HasSubstr("no word"));
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
// In which room of the apartment each thing is, by its true geometry.
#include "hypermap/io/archive/map_places.hpp"
#include "hypermap/io/options/place_rules_file.hpp"
#include "hypermap/io/simulator/scene_file.hpp"
#include "hypermap/io/simulator/simulation_truth.hpp"
#include "support/sanitized.hpp"
#include "support/test_data.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::SizeIs;

/// By the plan of data/scenes/apartment.yaml.
std::string true_place(const Eigen::Vector2d& at) {
  if (at.x() > 3.85 && at.x() < 5.15) return "corridor";
  if (at.x() < 3.85) return at.y() > 3.55 ? "kitchen" : "living room";
  return at.y() > 3.55 ? "bedroom" : "office";
}

MapArchive true_map(const Scene& scene, const FurnishedScene& furnished) {
  MapArchive archive;
  auto occupancy = true_occupancy(furnished, scene.waypoints);
  EXPECT_TRUE(occupancy) << to_string(occupancy.error());
  EXPECT_TRUE(archive.hypermap.add_layer({.info = {.name = "occupancy", .file = "occupancy"},
                                          .content = OccupancyLayer(*std::move(occupancy))}));
  std::vector<SemanticObject> objects;
  for (const PlacedObject& placed : furnished.objects) {
    objects.push_back(
        {.id = placed.id.value, .name = placed.class_name, .parts = {placed.footprint}});
  }
  EXPECT_TRUE(
      archive.hypermap.add_layer({.info = {.name = "semantic", .file = "semantic"},
                                  .content = SemanticLayer::create(std::move(objects)).value()}));
  return archive;
}

TEST(ApartmentPlaces, EveryObjectIsInItsRightRoom) {
  const auto scene = load_scene(test::source_path("data/scenes/apartment.yaml"));
  ASSERT_TRUE(scene) << to_string(scene.error());
  const auto rules = read_place_rules(test::source_path("data/places.yaml"));
  ASSERT_TRUE(rules) << to_string(rules.error());
  const auto classifier = BelongingsClassifier::create(*rules).value();
  for (int seed = 0; seed < test::repetitions(4); ++seed) {
    const auto furnished = furnish(*scene, static_cast<std::uint64_t>(seed)).value();
    const MapArchive archive = true_map(*scene, furnished);
    const MapPlaces places = map_places(archive, classifier).value();
    ASSERT_THAT(places.rooms, SizeIs(5)) << seed;
    EXPECT_THAT(places.plan.doorways, SizeIs(4)) << seed;
    for (const PlacedObject& placed : furnished.objects) {
      const RoomNumber room = places.room_of.at(placed.id.value);
      ASSERT_NE(room, kNoRoom) << placed.name;
      const std::string place = true_place(placed.centroid_in_map.head<2>());
      EXPECT_EQ(true_place(places.rooms[room - 1].room.middle), place) << placed.name;
      const auto& found = places.rooms[room - 1].place;
      const bool says_too_little = place == "corridor";  // an umbrella and a plant
      EXPECT_EQ(found, says_too_little ? std::nullopt : std::optional(place)) << placed.name;
    }
    const auto end = [&](const char* name) { return route_end(archive, places, name).value(); };
    const PlaceRoute route = find_place_route(places, end("oven"), end("bed")).value();
    ASSERT_THAT(route.doorways, SizeIs(2)) << "through the corridor";
    EXPECT_LT((route.doorways[0].position - Eigen::Vector2d(3.85, 4.65)).norm(), 0.2);
    EXPECT_LT((route.doorways[1].position - Eigen::Vector2d(5.15, 4.65)).norm(), 0.2);
  }
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/map_places.hpp"

#include "small_flat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(MapPlaces, EachObjectIsInItsRoomAndEachRoomIsWhatStandsInIt) {
  const MapPlaces places = map_places(test::small_flat(), test::home()).value();
  ASSERT_THAT(places.rooms, SizeIs(2));
  EXPECT_THAT(places.rooms[0].objects, ElementsAre(3));
  EXPECT_THAT(places.rooms[1].objects, ElementsAre(5, 7, 9));
  EXPECT_EQ(places.room_of.at(11), kNoRoom) << "0.4 m and more from the bedroom, around its corner";
  EXPECT_EQ(places.rooms[0].place, "kitchen");
  EXPECT_NEAR(places.rooms[0].belief.front().probability, 0.9, 1e-12);
  EXPECT_EQ(places.rooms[1].place, "bedroom");
  EXPECT_NEAR(places.rooms[1].room.area_m2, 9.0, 0.1) << "the bed stands on the floor";
  EXPECT_EQ(room_name(places, 1), "the kitchen (room 1)");
  EXPECT_EQ(room_name(places, kNoRoom), "no room");
}

/// The space over a rectangle: occupied from 0.1 m up to `top_m`, free above that up to 1.4 m.
SemanticOctree low_over(const Rect& rect, double top_m) {
  const SemanticOctree empty = SemanticOctree::create({}).value();
  std::vector<StoredLeaf> leaves;
  for (double x = rect.min.x() + 0.025; x < rect.max.x(); x += 0.05) {
    for (double y = rect.min.y() + 0.025; y < rect.max.y(); y += 0.05) {
      for (double z = 0.125; z < 1.4; z += 0.05) {
        const auto key = empty.grid().key(PointInMap{Eigen::Vector3d(x, y, z)});
        const MilliLogOdds log_odds = z < top_m ? MilliLogOdds{1000} : MilliLogOdds{-1000};
        leaves.push_back({.key = key.value(), .log_odds = log_odds});
      }
    }
  }
  return SemanticOctree::from_leaves({}, leaves).value();
}

TEST(MapPlaces, WhatWasLookedOverIsNoWallThoughNobodyNamedIt) {
  MapArchive archive = test::small_flat();
  archive.hypermap.remove_layer("semantic");  // so nobody knows of the bed: 1.6 m by 2 m
  const auto bedroom_m2 = [&] {
    const MapPlaces places = map_places(archive, test::home()).value();
    return places.rooms[1].room.area_m2;
  };
  EXPECT_NEAR(bedroom_m2(), 9.0 - 3.2, 0.1);
  archive.octree = low_over({{5.5, 1}, {7.1, 3}}, 0.5);
  EXPECT_NEAR(bedroom_m2(), 9.0, 0.1);
  archive.octree = low_over({{5.5, 1}, {7.1, 3}}, 1.4);
  EXPECT_NEAR(bedroom_m2(), 9.0 - 3.2, 0.1) << "a wardrobe may be a wall";
}

TEST(MapPlaces, WhatIsBelievedOfAnObjectCountsMoreThanItsName) {
  MapArchive archive = test::small_flat();
  const ClassId bed = archive.classes.add("bed").value();
  Object object;
  object.id = ObjectId{3};
  object.belief.observe(std::vector<ClassEvidence>{{bed, Probability(0.99)}}, Probability(0.5));
  archive.objects = ObjectMap::restore({object}, ObjectId{4}).value();
  const MapPlaces places = map_places(archive, test::home()).value();
  EXPECT_NE(places.rooms[0].place, "kitchen");
}

TEST(MapPlaces, AnUnknownRoomHasANumberAlone) {
  MapArchive archive = test::small_flat();
  PlaceRules rules;
  rules.places = {"garden", "kitchen"};
  rules.belongings = {{"tree", {{"garden", 9}}}};
  const MapPlaces places = map_places(archive, BelongingsClassifier::create(rules).value()).value();
  EXPECT_EQ(places.rooms[0].place, std::nullopt);
  EXPECT_EQ(room_name(places, 1), "room 1");
}

TEST(MapPlaces, WithoutAnOccupancyGridThereAreNone) {
  const auto none = map_places(MapArchive{}, test::home());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(none.error().field, "occupancy");
  MapArchive alone = test::small_flat();
  alone.hypermap.remove_layer("semantic");
  EXPECT_THAT(map_places(alone, test::home()).value().rooms, SizeIs(2));
}

TEST(PlaceRoute, LeadsThroughTheDoorway) {
  const MapArchive archive = test::small_flat();
  const MapPlaces places = map_places(archive, test::home()).value();
  const RouteEnd oven = route_end(archive, places, "Oven").value();
  const RouteEnd cup = route_end(archive, places, "7").value();
  EXPECT_EQ(oven.name, "oven 3");
  EXPECT_EQ(cup.room, 2U);
  const PlaceRoute route = find_place_route(places, oven, cup).value();
  EXPECT_THAT(route.rooms, ElementsAre(1, 2));
  ASSERT_THAT(route.doorways, SizeIs(1));
  const Eigen::Vector2d door = route.doorways[0].position;
  EXPECT_LT((door - Eigen::Vector2d(4.05, 1.45)).norm(), 0.16);
  EXPECT_NEAR(
      route.length_m,
      (door - Eigen::Vector2d(0.3, 2.3)).norm() + (door - Eigen::Vector2d(6.05, 2.05)).norm(),
      1e-9);
  EXPECT_EQ(route.cost, route.length_m);
  // A metre in the kitchen, the room of the oven, costs 3.
  const PlaceRoute dear = find_place_route(places, oven, cup, {{"kitchen", 3.0}}).value();
  EXPECT_EQ(dear.length_m, route.length_m);
  EXPECT_NEAR(dear.cost, route.length_m + 2.0 * (door - Eigen::Vector2d(0.3, 2.3)).norm(), 1e-9);
  const PlaceRoute within =
      find_place_route(places, cup, route_end(archive, places, "bed").value()).value();
  EXPECT_THAT(within.rooms, ElementsAre(2));
  EXPECT_THAT(within.doorways, IsEmpty());
}

TEST(PlaceRoute, AnEndIsAnObjectARoomOrAPlace) {
  const MapArchive archive = test::small_flat();
  const MapPlaces places = map_places(archive, test::home()).value();
  EXPECT_EQ(route_end(archive, places, "kitchen")->room, 1U);
  EXPECT_EQ(route_end(archive, places, "room 2")->room, 2U);
  EXPECT_EQ(route_end(archive, places, "5")->object, 5U);
  const auto what = [&](const char* text) { return route_end(archive, places, text).error().what; };
  EXPECT_THAT(what("room 3"), HasSubstr("room 1"));
  EXPECT_THAT(what("4"), HasSubstr("no object has the id 4"));
  EXPECT_THAT(what("tree"), HasSubstr("is in no room"));
  EXPECT_THAT(what("kitchn"), HasSubstr("kitchen"));
}

TEST(PlaceRoute, WithoutADoorwayThereIsNone) {
  MapArchive archive = test::small_flat();
  OccupancyGrid grid = archive.hypermap.find_as<OccupancyLayer>("occupancy")->grid;
  for (int row = 0; row < 80; ++row) grid.set({90, row}, kOccupiedCell);
  EXPECT_TRUE(archive.hypermap.set_content("occupancy", OccupancyLayer(grid)));
  const MapPlaces places = map_places(archive, test::home()).value();
  const auto route = find_place_route(places,
                                      route_end(archive, places, "oven").value(),
                                      route_end(archive, places, "bed").value());
  ASSERT_FALSE(route);
  EXPECT_EQ(route.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace hypermap

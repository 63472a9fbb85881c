// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/vertex_places.hpp"

#include "small_flat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Vertices 0 to 3 at x = 1, 1.95, 2.9 and 3.85 in the kitchen of `small_flat`, 4 at x = 4.8 in its
/// bedroom; the oven (3) is in the map as an object.
MapArchive walked_flat() {
  MapArchive archive = test::small_flat();
  archive.topological_map.emplace();
  archive.topological_map->observe({1, 1.45, 1});
  archive.topological_map->observe({4.85, 1.45, 1});
  const ClassId oven = archive.classes.add("oven").value();
  Object object;
  object.id = ObjectId{3};
  object.centroid_in_map = {0.3, 2.3, 0.5};
  object.box = {{0, 2, 0}, {0.6, 2.6, 1}};
  object.belief.observe(std::vector<ClassEvidence>{{oven, Probability(0.99)}}, Probability(0.5));
  archive.objects = ObjectMap::restore({object}, ObjectId{4}).value();
  return archive;
}

std::vector<VertexPlace> places_of(const MapArchive& archive,
                                   const PlaceClassifier& classifier = test::home()) {
  return vertex_places(archive, map_places(archive, classifier).value(), classifier);
}

// [smap] pseudocode 3.4: this_thing, related_things.
TEST(VertexPlaces, AVertexIsOfTheRoomBelowItAndHasTheObjectsNearestToIt) {
  const std::vector<VertexPlace> vertices = places_of(walked_flat());
  ASSERT_THAT(vertices, SizeIs(5));
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(vertices[i].room, 1U) << i;
  EXPECT_EQ(vertices[4].room, 2U);
  EXPECT_EQ(vertices[3].belief.front().place, "kitchen");
  EXPECT_EQ(vertices[4].place, "bedroom");
  EXPECT_THAT(vertices[0].objects, ElementsAre(3));
  EXPECT_THAT(vertices[1].objects, IsEmpty());
}

/// A tree outside of all rooms, and vertices 0 to 5 that lead away from it.
MapArchive walked_garden() {
  MapArchive archive = test::small_flat();
  const ClassId tree = archive.classes.add("tree").value();
  Object object;
  object.id = ObjectId{11};
  object.centroid_in_map = {9, 6, 1};
  object.box = {{8.5, 5.5, 0}, {9.5, 6.5, 2}};
  object.existence = LogOdds(10);
  object.belief.observe(std::vector<ClassEvidence>{{tree, Probability(0.999)}}, Probability(0.5));
  archive.objects = ObjectMap::restore({object}, ObjectId{12}).value();
  archive.topological_map.emplace();
  archive.topological_map->observe({9, 6.5, 1});
  archive.topological_map->observe({9, 6.5 + 5 * 0.95, 1});
  return archive;
}

BelongingsClassifier gardens() {
  PlaceRules rules;
  rules.places = {"garden", "kitchen"};
  rules.belongings = {{"tree", {{"garden", 50}}}};
  return BelongingsClassifier::create(rules).value();
}

TEST(VertexPlaces, OneInNoRoomIsWhatTheObjectsAroundItMakeOfIt) {
  const std::vector<VertexPlace> vertices = places_of(walked_garden(), gardens());
  ASSERT_THAT(vertices, SizeIs(6));
  EXPECT_EQ(vertices[0].room, kNoRoom);
  EXPECT_EQ(vertices[0].place, "garden");
  EXPECT_EQ(vertices[3].place, "garden") << "three edges away";
  EXPECT_EQ(vertices[4].place, std::nullopt) << "four edges away";
}

TEST(PlaceName, OfAnObjectInNoRoomIsItsVertexs) {
  const MapArchive archive = walked_garden();
  const MapPlaces places = map_places(archive, gardens()).value();
  const auto vertices = vertex_places(archive, places, gardens());
  EXPECT_EQ(telling_vertex(places, vertices, 11), VertexId{0});
  EXPECT_EQ(place_name(places, vertices, 11), "the garden");
  EXPECT_EQ(place_name(places, {}, 11), "no room") << "without a topological map";
  EXPECT_EQ(place_name(places, vertices, 3), "room 1") << "the map has no such object";
}

TEST(PlaceName, OfARoomWithAClassIsTheRooms) {
  const MapArchive archive = walked_flat();
  const MapPlaces places = map_places(archive, test::home()).value();
  const auto vertices = vertex_places(archive, places, test::home());
  EXPECT_EQ(vertices[0].place, "kitchen");
  EXPECT_EQ(telling_vertex(places, vertices, 3), std::nullopt);
  EXPECT_EQ(place_name(places, vertices, 3), "the kitchen (room 1)");
}

// An oven, a bed and a desk say 17 : 9 : 9, so that none is 0.5 probable; at the vertices, which
// know of the oven alone, it is 17 : 1 : 1.
TEST(PlaceName, InARoomWithoutAClassIsItsVertexs) {
  MapArchive archive = walked_flat();
  archive.objects.modify(ObjectId{3}, [](Object& oven) { oven.existence = LogOdds(10); });
  const SemanticUpdate more{.to_add = {test::shape(13, "bed", {{1, 0}, {2, 1}}),
                                       test::shape(15, "desk", {{2.2, 0}, {3.2, 1}})}};
  ASSERT_TRUE(archive.hypermap.update("semantic", more));
  PlaceRules rules;
  rules.places = {"bedroom", "kitchen", "office"};
  rules.belongings = {
      {"oven", {{"kitchen", 17}}}, {"bed", {{"bedroom", 9}}}, {"desk", {{"office", 9}}}};
  const auto classifier = BelongingsClassifier::create(rules).value();
  const MapPlaces places = map_places(archive, classifier).value();
  EXPECT_EQ(room_name(places, 1), "room 1");
  auto vertices = vertex_places(archive, places, classifier);
  EXPECT_EQ(telling_vertex(places, vertices, 3), VertexId{0});
  EXPECT_EQ(place_name(places, vertices, 3), "the kitchen of room 1");
  EXPECT_EQ(place_name(places, vertices, 13), "room 1") << "no vertex has it";
  vertices[0].room = 2;
  EXPECT_EQ(place_name(places, vertices, 3), "room 1") << "a wall parts it from its vertex";
}

// [smap] 3.5.1: traversability cost of a class of places. Edges of 0.95 m: three in the kitchen,
// one half in the bedroom, where a metre costs 2.
TEST(VertexRoute, AMetreCostsWhatItDoesAtItsVertices) {
  const MapArchive archive = walked_flat();
  const MapPlaces rooms = map_places(archive, test::home()).value();
  const auto vertices = places_of(archive);
  const RouteEnd oven = route_end(archive, rooms, "oven").value();
  const RouteEnd bed = route_end(archive, rooms, "room 2").value();
  const auto way = find_vertex_route(archive, vertices, oven, bed, {{"bedroom", 2.0}}).value();
  EXPECT_THAT(way.vertices,
              ElementsAre(VertexId{0}, VertexId{1}, VertexId{2}, VertexId{3}, VertexId{4}));
  EXPECT_NEAR(way.length_m, 4 * 0.95, 1e-9);
  EXPECT_NEAR(way.cost, 3 * 0.95 + 0.475 + 2 * 0.475, 1e-9);
  EXPECT_NEAR(find_vertex_route(archive, vertices, oven, bed).value().cost, way.length_m, 1e-9);
}

TEST(VertexRoute, PiecesThatNoEdgeJoinsAreTold) {
  MapArchive archive = walked_flat();
  archive.topological_map->interrupt();
  archive.topological_map->observe({7, 2.9, 1});
  const MapPlaces rooms = map_places(archive, test::home()).value();
  const RouteEnd oven = route_end(archive, rooms, "oven").value();
  const RouteEnd bed{.name = "the corner", .position = {7, 2.9}, .room = 2};
  const auto none = find_vertex_route(archive, places_of(archive), oven, bed);
  ASSERT_FALSE(none);
  EXPECT_EQ(
      to_string(none.error()),
      "no edges of the topological map join vertex 0, at oven 3, and vertex 5, at the corner");
}

TEST(VertexPlaces, WithoutATopologicalMapThereAreNone) {
  const MapArchive archive = test::small_flat();
  EXPECT_THAT(places_of(archive), IsEmpty());
  const RouteEnd end{.name = "here"};
  const auto none = find_vertex_route(archive, {}, end, end);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace hypermap

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

TEST(VertexPlaces, OneInNoRoomIsWhatTheObjectsAroundItMakeOfIt) {
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
  PlaceRules rules;
  rules.places = {"garden", "kitchen"};
  rules.belongings = {{"tree", {{"garden", 50}}}};
  const auto classifier = BelongingsClassifier::create(rules).value();
  const std::vector<VertexPlace> vertices = places_of(archive, classifier);
  ASSERT_THAT(vertices, SizeIs(6));
  EXPECT_EQ(vertices[0].room, kNoRoom);
  EXPECT_EQ(vertices[0].place, "garden");
  EXPECT_EQ(vertices[3].place, "garden") << "three edges away";
  EXPECT_EQ(vertices[4].place, std::nullopt) << "four edges away";
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

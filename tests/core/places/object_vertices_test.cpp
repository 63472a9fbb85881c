// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/object_vertices.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/places/topological_routes.hpp"
#include "support/object_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing_support::box_at;

Object object_at(const Eigen::Vector3d& centre) {
  Object object;
  object.box = box_at(centre, {0.2, 0.2, 0.2});
  object.centroid_in_map = centre;
  return object;
}

TEST(ObjectVertices, AnObjectBelongsToItsNearestVertexAtAnyTime) {
  TopologicalMap map;
  const Object cup = object_at({0.8, 0, 1});
  EXPECT_EQ(vertex_of(map, cup), std::nullopt);
  map.observe({0, 0, 1});
  EXPECT_EQ(vertex_of(map, cup), VertexId{0});
  map.observe({0.95, 0, 1});
  map.observe({1.0, 0, 1});  // leaves vertex 0 at 0.95
  EXPECT_EQ(vertex_of(map, cup), VertexId{1}) << "0.15 m to the second vertex, 0.8 to the first";
}

TEST(ObjectVertices, NearObjectsAreThoseWithinSoManyEdges) {
  // [smap] 3.5.4: a corridor with a vertex each 0.95 m, an object beside each of five.
  TopologicalMap map;
  for (int i = 0; i <= 40; ++i) map.observe({0.1 * i, 0, 1});
  ASSERT_EQ(map.vertices().size(), 5U);
  ObjectMap objects;
  for (int i = 0; i < 5; ++i) objects.add(object_at({0.95 * i, 0.5, 1}));
  EXPECT_THAT(objects_near(map, objects, {0}, 0), ElementsAre(ObjectId{1}));
  EXPECT_THAT(objects_near(map, objects, {0}, 3),
              ElementsAre(ObjectId{1}, ObjectId{2}, ObjectId{3}, ObjectId{4}));
  EXPECT_THAT(objects_near(map, objects, {2}, 1),
              ElementsAre(ObjectId{2}, ObjectId{3}, ObjectId{4}));
}

TEST(ObjectVertices, NearObjectsAreThoseOfAScanOverAll) {
  CounterRng rng(3, 1);
  TopologicalMap map;
  ObjectMap objects;
  for (int i = 0; i < 200; ++i) {
    map.observe({rng.uniform(0.0, 9.0), rng.uniform(0.0, 9.0), rng.uniform(0.5, 1.5)});
    objects.add(
        object_at({rng.uniform(-4.0, 13.0), rng.uniform(-4.0, 13.0), rng.uniform(0.0, 2.0)}));
  }
  for (const Object& object : objects.objects()) map.cover(object.centroid_in_map);
  for (std::uint32_t from = 0; from < map.vertices().size(); from += 17) {
    const auto vertices = neighbourhood(map, VertexId{from}, 2);
    std::vector<ObjectId> expected;
    for (const Object& object : objects.objects()) {
      if (std::ranges::binary_search(vertices, *vertex_of(map, object)))
        expected.push_back(object.id);
    }
    EXPECT_EQ(objects_near(map, objects, VertexId{from}, 2), expected);
  }
}

// [smap] 3.5.1: support vertices are for what is farther than 2 V_d from a vertex.
TEST(RelatedVertex, IsOnTheWayWithinTwiceTheVertexDistance) {
  TopologicalMap map;
  EXPECT_EQ(related_vertex(map, {0, 0, 1}), std::nullopt);
  map.observe({0, 0, 1});
  map.cover({2.5, 0, 1});
  ASSERT_EQ(map.vertices().size(), 3U) << "support vertices at 0.95 and 1.9 m";
  EXPECT_EQ(vertex_of(map, object_at({1.99, 0, 1})), VertexId{2});
  EXPECT_EQ(related_vertex(map, {1.99, 0, 1}), VertexId{0});
  EXPECT_EQ(related_vertex(map, {2.0, 0, 1}), VertexId{2}) << "2 V_d is not near";
  EXPECT_EQ(related_vertex(map, {0.94, 0, 1}), VertexId{0}) << "though a support vertex is there";
}

TEST(VertexNeighbourhood, HoldsWhatIsRelatedToAVertexWithinSoManyEdges) {
  // As the corridor above: objects beside vertices 0 to 4, and one beyond 2 V_d of all, to which
  // two support vertices lead from the last one.
  TopologicalMap map;
  for (int i = 0; i <= 40; ++i) map.observe({0.1 * i, 0, 1});
  map.cover({3.8, 2.2, 1});
  for (const auto& [layers, last] : {std::pair{0, 0}, std::pair{1, 1}, std::pair{3, 3}}) {
    const VertexNeighbourhood near(map, {0.1, 0, 1}, layers);
    for (int i = 0; i < 5; ++i)
      EXPECT_EQ(near.contains({0.95 * i, 0.5, 1}), i <= last) << layers << ", " << i;
    EXPECT_FALSE(near.contains({3.8, 2.2, 1}));
  }
  EXPECT_FALSE(VertexNeighbourhood(map, {0, 0, 1}, 5).contains({3.8, 2.2, 1}));
  EXPECT_TRUE(VertexNeighbourhood(map, {0, 0, 1}, 6).contains({3.8, 2.2, 1}));
}

}  // namespace
}  // namespace hypermap

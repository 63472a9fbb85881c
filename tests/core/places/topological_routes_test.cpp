// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/topological_routes.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

/// Vertices at random in a square, those joined that are near, each second time.
TopologicalMap random_graph(std::uint64_t seed) {
  CounterRng rng(seed, 1);
  std::vector<TopologicalVertex> vertices;
  vertices.reserve(30);
  for (int i = 0; i < 30; ++i) {
    vertices.push_back({{rng.uniform(0, 3), rng.uniform(0, 3), 0}, VertexKind::kPath});
  }
  std::vector<TopologicalEdge> edges;
  for (std::uint32_t a = 0; a < vertices.size(); ++a) {
    for (std::uint32_t b = a + 1; b < vertices.size(); ++b) {
      const double away_m = (vertices[a].position_in_map - vertices[b].position_in_map).norm();
      if (away_m <= 0.9 && rng.chance(0.5)) edges.push_back({{a}, {b}});
    }
  }
  return TopologicalMap::create({}, vertices, edges, std::nullopt).value();
}

/// Least number of edges, or least cost, between all vertices (Floyd and Warshall).
template <class EdgeCost>
std::vector<std::vector<double>> all_pairs(const TopologicalMap& map, const EdgeCost& cost_of) {
  const std::size_t n = map.vertices().size();
  std::vector cost(n, std::vector(n, std::numeric_limits<double>::infinity()));
  for (std::size_t i = 0; i < n; ++i) cost[i][i] = 0.0;
  for (const TopologicalEdge& edge : map.edges()) {
    cost[edge.from.value][edge.to.value] = cost_of(edge);
    cost[edge.to.value][edge.from.value] = cost_of(edge);
  }
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j)
        cost[i][j] = std::min(cost[i][j], cost[i][k] + cost[k][j]);
    }
  }
  return cost;
}

/// 0 - 1 - 2 - 3 straight on, half a metre apart, and a detour 1 - 4 - 2.
TopologicalMap with_detour() {
  std::vector<TopologicalVertex> vertices;
  vertices.reserve(5);
  for (int i = 0; i < 4; ++i) vertices.push_back({{0.5 * i, 0, 0}, VertexKind::kPath});
  vertices.push_back({{0.75, 0.6, 0}, VertexKind::kSupport});
  const std::vector<TopologicalEdge> edges{
      {{0}, {1}}, {{1}, {2}}, {{1}, {4}}, {{2}, {3}}, {{2}, {4}}};
  return TopologicalMap::create({}, vertices, edges, std::nullopt).value();
}

TEST(Neighbourhood, LayersAreEdges) {
  const TopologicalMap map = with_detour();
  EXPECT_THAT(neighbourhood(map, {0}, 0), ElementsAre(VertexId{0}));
  EXPECT_THAT(neighbourhood(map, {0}, 1), ElementsAre(VertexId{0}, VertexId{1}));
  EXPECT_THAT(neighbourhood(map, {0}, 2),
              ElementsAre(VertexId{0}, VertexId{1}, VertexId{2}, VertexId{4}));
  EXPECT_THAT(neighbourhood(map, {0}, 9), SizeIs(5));
}

TEST(Neighbourhood, IsThatOfAllShortestWays) {
  for (int seed = 0; seed < test::repetitions(8); ++seed) {
    const TopologicalMap map = random_graph(static_cast<std::uint64_t>(seed));
    const auto layers = all_pairs(map, [](const TopologicalEdge&) { return 1.0; });
    for (const int num_layers : {1, 3, 5}) {  // [smap] 3.5.4: 3; 3.5.5: 5
      for (std::uint32_t from = 0; from < map.vertices().size(); ++from) {
        std::vector<VertexId> expected;
        for (std::uint32_t to = 0; to < map.vertices().size(); ++to) {
          if (layers[from][to] <= num_layers) expected.push_back({to});
        }
        EXPECT_EQ(neighbourhood(map, {from}, num_layers), expected);
      }
    }
  }
}

TEST(CheapestRoute, HalfOfAnEdgeCostsWhatEachEndCosts) {
  const TopologicalMap map = with_detour();
  const auto plain = cheapest_route(map, {0}, {3});
  ASSERT_TRUE(plain.has_value());
  EXPECT_THAT(plain->vertices, ElementsAre(VertexId{0}, VertexId{1}, VertexId{2}, VertexId{3}));
  EXPECT_DOUBLE_EQ(plain->length_m, 1.5);
  EXPECT_DOUBLE_EQ(plain->cost, 1.5);
  // Vertex 3 costs 5: the last edge 0.5 * (1 + 5) / 2 = 1.5.
  const auto dear =
      cheapest_route(map, {0}, {3}, [](VertexId id) { return id.value == 3 ? 5.0 : 1.0; });
  EXPECT_DOUBLE_EQ(dear->cost, 2.5);
}

TEST(CheapestRoute, WhereNoWayMayLeadNoneDoes) {
  const TopologicalMap map = with_detour();
  const auto only_through = [](std::uint32_t closed) {
    return [closed](VertexId id) {
      return id.value == closed ? std::numeric_limits<double>::infinity() : 1.0;
    };
  };
  EXPECT_FALSE(cheapest_route(map, {0}, {3}, only_through(2)).has_value());
  EXPECT_TRUE(cheapest_route(map, {0}, {3}, only_through(4)).has_value());
  const auto nowhere = cheapest_route(map, {1}, {1}, only_through(1));
  ASSERT_TRUE(nowhere.has_value());
  EXPECT_THAT(nowhere->vertices, ElementsAre(VertexId{1}));
  EXPECT_EQ(nowhere->cost, 0.0);
}

TEST(CheapestRoute, IsAsCheapAsOfAllPairs) {
  for (int seed = 0; seed < test::repetitions(8); ++seed) {
    const TopologicalMap map = random_graph(static_cast<std::uint64_t>(seed));
    const auto factor = [&](VertexId id) { return 1.0 + 3.0 * (id.value % 4 == 0 ? 1.0 : 0.0); };
    const auto costs = all_pairs(map, [&](const TopologicalEdge& edge) {
      return map.distance_m(edge.from, edge.to) * 0.5 * (factor(edge.from) + factor(edge.to));
    });
    for (std::uint32_t to = 0; to < map.vertices().size(); ++to) {
      const auto route = cheapest_route(map, {0}, {to}, factor);
      ASSERT_EQ(route.has_value(), costs[0][to] < std::numeric_limits<double>::infinity());
      if (!route) continue;
      EXPECT_NEAR(route->cost, costs[0][to], 1e-12);
      double walked_m = 0.0;
      for (std::size_t i = 1; i < route->vertices.size(); ++i) {
        walked_m += map.distance_m(route->vertices[i - 1], route->vertices[i]);
        EXPECT_TRUE(
            std::ranges::binary_search(map.neighbours(route->vertices[i - 1]), route->vertices[i]));
      }
      EXPECT_NEAR(route->length_m, walked_m, 1e-12);
    }
  }
}

TEST(BrokenRules, EachIsFound) {
  // [smap] 3.5.1 with V_d = 1 m, E_f = 0.95: edges of 0.95 m, 0.96 m and 2 m.
  const std::vector<TopologicalVertex> vertices{{{0, 0, 0}, VertexKind::kPath},
                                                {{0.95, 0, 0}, VertexKind::kPath},
                                                {{1.91, 0, 0}, VertexKind::kPath},
                                                {{0, 2, 0}, VertexKind::kSupport}};
  const std::vector<TopologicalEdge> edges{{{0}, {1}}, {{0}, {3}}, {{1}, {2}}};
  const std::vector<Eigen::Vector3d> objects{{0.5, 0, 0}, {-1, 0, 0}, {0, 0, 2.5}};
  const std::vector<BrokenRule> broken = broken_rules({}, vertices, edges, objects);
  ASSERT_THAT(broken, SizeIs(5));
  EXPECT_EQ(broken[0], (BrokenRule{1, "vertices 0 and 3 are joined and 2 m apart"}));
  EXPECT_EQ(broken[1], (BrokenRule{3, "vertices 0 and 3 are joined and 2 m apart"}));
  EXPECT_EQ(broken[2].rule, 3);
  EXPECT_EQ(broken[3], (BrokenRule{2, "object 1 is 1 m from the nearest vertex"}));
  EXPECT_EQ(broken[4].rule, 2);
  EXPECT_THAT(broken_rules(TopologicalMap(), {}), IsEmpty());
  EXPECT_THAT(broken_rules(TopologicalMap(), objects), SizeIs(3));
}

}  // namespace
}  // namespace hypermap

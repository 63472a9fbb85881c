// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/topological_map.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/places/topological_routes.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace hypermap {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

double length_m(const TopologicalMap& map, const TopologicalEdge& edge) {
  return map.distance_m(edge.from, edge.to);
}

/// A walk in a hall of 12 m with some rests, returns and, once in a hundred steps, a jump.
std::vector<Vector3d> random_walk(std::uint64_t seed, int num_steps) {
  CounterRng rng(seed, 1);
  std::vector<Vector3d> walk{{6, 6, 1.2}};
  double heading_rad = 0.0;
  for (int i = 0; i < num_steps; ++i) {
    heading_rad += rng.uniform(-0.6, 0.6);
    const double step_m = rng.chance(0.01) ? rng.uniform(1.0, 9.0) : rng.uniform(0.0, 0.5);
    Vector3d next = walk.back();
    next += step_m * Vector3d(std::cos(heading_rad), std::sin(heading_rad), rng.uniform(-0.1, 0.1));
    next = next.cwiseMax(Vector3d(0, 0, 0.3)).cwiseMin(Vector3d(12, 12, 2));
    walk.push_back(rng.chance(0.02) ? walk[rng.below(static_cast<std::uint32_t>(walk.size()))]
                                    : next);
  }
  return walk;
}

TEST(TopologicalMap, AStraightWalkMakesAVertexEachNinetyFiveCentimetres) {
  // [smap] 3.5.1: V_d E_f = 1 m * 0.95. 3 m in steps of 0.1 m: at 0, 0.95, 1.9, 2.85.
  TopologicalMap map;
  for (int i = 0; i <= 30; ++i) map.observe({0.1 * i, 0, 1});
  ASSERT_THAT(map.vertices(), SizeIs(4));
  for (int i = 0; i < 4; ++i) {
    const TopologicalVertex& vertex = map.vertices()[static_cast<std::size_t>(i)];
    EXPECT_NEAR(vertex.position_in_map.x(), 0.95 * i, 1e-9);
    EXPECT_EQ(vertex.kind, VertexKind::kPath);
  }
  EXPECT_THAT(
      map.edges(),
      ElementsAre(TopologicalEdge{{0}, {1}}, TopologicalEdge{{1}, {2}}, TopologicalEdge{{2}, {3}}));
}

TEST(TopologicalMap, OneLongStepMakesTheVerticesInBetween) {
  TopologicalMap small_steps;
  TopologicalMap jump;
  for (int i = 0; i <= 100; ++i) small_steps.observe({0.1 * i, 0, 1});
  jump.observe({0, 0, 1});
  jump.observe({10, 0, 1});
  ASSERT_THAT(jump.vertices(), SizeIs(11));  // floor(10 / 0.95) + 1
  for (std::size_t i = 0; i < 11; ++i) {
    EXPECT_NEAR(jump.vertices()[i].position_in_map.x(),
                small_steps.vertices()[i].position_in_map.x(),
                1e-9);
  }
  EXPECT_EQ(jump.edges(), small_steps.edges());
}

TEST(TopologicalMap, StandingStillAndGoingBackMakeNothing) {
  TopologicalMap map;
  for (int there = 0; there < 5; ++there) {
    for (int i = 0; i <= 40; ++i) map.observe({0.1 * i, 0, 1});
    for (int i = 40; i >= 0; --i) map.observe({0.1 * i, 0, 1});
  }
  EXPECT_THAT(map.vertices(), SizeIs(5));
  EXPECT_THAT(map.edges(), SizeIs(4));
  EXPECT_EQ(map.nearest({0, 0, 1}), VertexId{0});
}

TEST(TopologicalMap, ALoopIsClosed) {
  TopologicalMap map;
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSteps;
    map.observe({3 * std::cos(angle), 3 * std::sin(angle), 1});
  }
  for (int i = 0; i <= 5; ++i) {
    const double angle = 0.1 * i;
    map.observe({3 * std::cos(angle), 3 * std::sin(angle), 1});
  }
  for (std::uint32_t i = 0; i < map.vertices().size(); ++i) {
    EXPECT_GE(map.neighbours({i}).size(), 2U) << i;
  }
  EXPECT_THAT(broken_rules(map, {}), IsEmpty());
}

TEST(TopologicalMap, APlaceBehindAWallIsNotCalledTheSame) {
  // Two ways 0.5 m apart with a wall between them, joined at their western ends.
  const IsWayFree is_free = [](const Vector3d& a, const Vector3d& b) {
    if ((a.y() < 0.25) == (b.y() < 0.25)) return true;
    const double share = (0.25 - a.y()) / (b.y() - a.y());
    return a.x() + share * (b.x() - a.x()) < 0.0;
  };
  const auto walked = [](const IsWayFree& way) {
    TopologicalMap map;
    for (int i = 0; i <= 40; ++i) map.observe({0.1 * i, 0, 1}, way);
    map.observe({-0.5, 0, 1}, way);
    map.observe({-0.5, 0.5, 1}, way);
    for (int i = 0; i <= 40; ++i) map.observe({0.1 * i, 0.5, 1}, way);
    return map;
  };
  const TopologicalMap open = walked({});
  const TopologicalMap walled = walked(is_free);
  EXPECT_THAT(open.vertices(), SizeIs(5));
  for (const TopologicalEdge& edge : walled.edges()) {
    EXPECT_TRUE(is_free(walled.vertices()[edge.from.value].position_in_map,
                        walled.vertices()[edge.to.value].position_in_map))
        << edge.from.value << " " << edge.to.value;
  }
  const auto there = cheapest_route(walled, {4}, walled.walk()->at);
  ASSERT_TRUE(there.has_value());
  EXPECT_GT(there->length_m, 7.0);
}

TEST(TopologicalMap, AnotherWalkIsAnotherPieceUntilItMeetsTheFirst) {
  TopologicalMap map;
  map.observe({0, 0, 1});
  map.observe({3, 0, 1});
  map.interrupt();
  map.observe({0, 8, 1});
  EXPECT_EQ(connected_pieces(map).back(), 1U);
  map.observe({0, 0, 1});
  EXPECT_EQ(connected_pieces(map), std::vector<std::size_t>(map.vertices().size(), 0));
  EXPECT_THAT(broken_rules(map, {}), IsEmpty());
}

// [smap] pseudocode 3.4.
TEST(TopologicalMap, AFarObjectGetsSupportVerticesTowardIt) {
  // 2.5 m away: after 0.95 m there are 1.55 m left, after 1.9 m 0.6 m, which is near.
  TopologicalMap map;
  map.observe({0, 0, 1});
  const VertexId id = map.cover({2.5, 0, 1});
  ASSERT_THAT(map.vertices(), SizeIs(3));
  EXPECT_EQ(id, VertexId{2});
  EXPECT_NEAR(map.vertices()[2].position_in_map.x(), 1.9, 1e-12);
  EXPECT_EQ(map.vertices()[2].kind, VertexKind::kSupport);
  EXPECT_THAT(map.edges(), ElementsAre(TopologicalEdge{{0}, {1}}, TopologicalEdge{{1}, {2}}));
  EXPECT_EQ(map.cover({2.5, 0, 1}), id) << "covered once is covered";
  EXPECT_THAT(map.vertices(), SizeIs(3));
}

TEST(TopologicalMap, NearIsNearerThanTheVertexDistance) {
  TopologicalMap map;
  map.observe({0, 0, 0});
  EXPECT_EQ(map.cover({0.999, 0, 0}), VertexId{0});
  EXPECT_EQ(map.cover({1.0, 0, 0}), VertexId{1}) << "exactly V_d is not near";
  TopologicalMap empty;
  EXPECT_EQ(empty.nearest({0, 0, 0}), std::nullopt);
  EXPECT_EQ(empty.cover({5, 5, 5}), VertexId{0});
}

TEST(TopologicalMap, RandomWalksObeyTheThreeRules) {
  for (int seed = 0; seed < test::repetitions(20); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 2);
    const TopologicalMapOptions options{.vertex_distance_m = rng.uniform(0.4, 2.0),
                                        .edge_factor = rng.uniform(0.5, 0.99)};
    TopologicalMap map(options);
    std::vector<Vector3d> objects;
    for (const Vector3d& position : random_walk(static_cast<std::uint64_t>(seed), 400)) {
      const VertexId at = map.observe(position);
      EXPECT_LE((map.vertices()[at.value].position_in_map - position).norm(),
                map.max_edge_m() + 1e-9);
      if (!rng.chance(0.1)) continue;
      const double range_m = rng.chance(0.1) ? 30.0 : 4.0;
      objects.emplace_back(position + range_m * Vector3d(rng.uniform(-1, 1),
                                                         rng.uniform(-1, 1),
                                                         rng.uniform(0, 0.5)));
      const VertexId of_object = map.cover(objects.back());
      EXPECT_EQ(of_object, map.nearest(objects.back()));
    }
    EXPECT_THAT(broken_rules(map, objects), IsEmpty()) << seed;
    const auto pieces = connected_pieces(map);
    EXPECT_TRUE(std::ranges::all_of(pieces, [](std::size_t piece) { return piece == 0; })) << seed;
  }
}

TEST(TopologicalMap, TheNearestVertexIsThatOfAScanOverAll) {
  CounterRng rng(7, 3);
  TopologicalMap map({.vertex_distance_m = 0.7, .edge_factor = 0.9});
  for (const Vector3d& position : random_walk(3, 600)) map.observe(position);
  for (int i = 0; i < 300; ++i) {
    const double spread_m = i % 3 == 0 ? 60.0 : 8.0;
    const Vector3d asked =
        Vector3d(6, 6, 1) +
        spread_m * Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    std::uint32_t best = 0;
    const auto away = [&](std::uint32_t id) {
      return (map.vertices()[id].position_in_map - asked).norm();
    };
    for (std::uint32_t id = 1; id < map.vertices().size(); ++id) {
      if (away(id) < away(best)) best = id;
    }
    EXPECT_EQ(map.nearest(asked), VertexId{best});
  }
}

TEST(TopologicalMap, TheNearestPathVertexIsThatOfAScanOverAll) {
  CounterRng rng(7, 4);
  TopologicalMap map({.vertex_distance_m = 0.7, .edge_factor = 0.9});
  for (const Vector3d& position : random_walk(4, 300)) {
    map.observe(position);
    map.cover(position +
              4.0 * Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)));
  }
  int num_found = 0;
  for (int i = 0; i < 300; ++i) {
    const Vector3d asked(rng.uniform(-8, 8), rng.uniform(-8, 8), rng.uniform(-8, 8));
    std::optional<VertexId> best;
    double best_m = 1.4;
    for (std::uint32_t id = 0; id < map.vertices().size(); ++id) {
      const auto& [position, kind] = map.vertices()[id];
      if (kind != VertexKind::kPath || (position - asked).norm() >= best_m) continue;
      best = VertexId{id};
      best_m = (position - asked).norm();
    }
    EXPECT_EQ(map.nearest_path_vertex(asked, 1.4), best);
    num_found += best ? 1 : 0;
  }
  EXPECT_THAT(num_found, testing::AllOf(testing::Gt(0), testing::Lt(300)));
}

TEST(TopologicalMap, ALongWalkInOneRoomDoesNotGrowForEver) {
  TopologicalMap map;
  CounterRng rng(11, 4);
  const auto wander = [&](int num_ways) {
    for (int i = 0; i < num_ways; ++i) map.observe({rng.uniform(0, 6), rng.uniform(0, 6), 1.2});
  };
  wander(500);
  const std::size_t after_some = map.vertices().size();
  wander(2000);
  EXPECT_LT(after_some, 200U);
  EXPECT_LT(map.vertices().size(), after_some + after_some / 2) << "four times as far again";
}

TEST(TopologicalMap, ItsPartsMakeItAgain) {
  TopologicalMap map;
  for (const Vector3d& position : random_walk(5, 200)) map.observe(position);
  map.cover({20, 3, 1});
  const auto edges = map.edges();
  auto again = TopologicalMap::create(map.options(), map.vertices(), edges, map.walk());
  ASSERT_TRUE(again.has_value()) << to_string(again.error());
  EXPECT_EQ(*again, map);
  again->observe({1, 1, 1});
  map.observe({1, 1, 1});
  EXPECT_EQ(*again, map) << "and goes on as it would";
}

TEST(TopologicalMap, WrongPartsAreRefusedByName) {
  const std::vector<TopologicalVertex> two{{{0, 0, 0}, VertexKind::kPath},
                                           {{0.5, 0, 0}, VertexKind::kPath}};
  const auto field = [&](std::vector<TopologicalVertex> vertices,
                         std::vector<TopologicalEdge> edges,
                         const std::optional<TopologicalWalk>& walk = std::nullopt) {
    const auto made = TopologicalMap::create({}, vertices, edges, walk);
    return made ? std::string() : made.error().field;
  };
  EXPECT_EQ(field(two, {{{0}, {1}}}), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(field({two[0], {{0, nan, 0}, VertexKind::kPath}}, {}), "vertices[1]");
  EXPECT_EQ(field({{{2e6, 0, 0}, VertexKind::kPath}}, {}), "vertices[0]");
  EXPECT_EQ(field(two, {{{0}, {2}}}), "edges[0]");
  EXPECT_EQ(field(two, {{{1}, {0}}}), "edges[0]");
  EXPECT_EQ(field(two, {{{0}, {1}}, {{0}, {1}}}), "edges[1]");
  EXPECT_EQ(field({two[0], {{0.951, 0, 0}, VertexKind::kPath}}, {{{0}, {1}}}), "edges[0]");
  EXPECT_EQ(field(two, {}, TopologicalWalk{{2}, {0, 0, 0}}), "walk");
  EXPECT_EQ(field(two, {}, TopologicalWalk{{0}, {3, 0, 0}}), "walk");
  EXPECT_EQ(TopologicalMap::create({.vertex_distance_m = 0}, {}, {}, {}).error().field,
            "vertex_distance_m");
}

TEST(TopologicalMap, NoEdgeIsLongerThanAllowedByManyTrials) {
  TopologicalMap map;
  for (const Vector3d& position : random_walk(9, 1000)) map.observe(position);
  double longest_m = 0.0;
  for (const TopologicalEdge& edge : map.edges())
    longest_m = std::max(longest_m, length_m(map, edge));
  EXPECT_LE(longest_m, 0.95 + 1e-9);
  EXPECT_GT(longest_m, 0.94);
}

}  // namespace
}  // namespace hypermap

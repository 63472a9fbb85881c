// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/merged_topological_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hypermap {
namespace {

using Eigen::Vector3d;

/// The map of a sensor that went straight along x at this y.
TopologicalMap straight_walk(double from_m, double to_m, double y_m) {
  TopologicalMap map;
  for (double x_m = from_m; x_m <= to_m; x_m += 0.25) map.observe({x_m, y_m, 1.0});
  return map;
}

bool is_any_way_free(const Vector3d&, const Vector3d&) {
  return true;
}

std::size_t num_edges_between(const TopologicalMap& map, std::size_t num_of_first) {
  const auto edges = map.edges();
  return static_cast<std::size_t>(std::ranges::count_if(edges, [&](const TopologicalEdge& edge) {
    return edge.from.value < num_of_first && edge.to.value >= num_of_first;
  }));
}

TEST(MergedTopologicalMap, WaysThatMeetAreJoined) {
  const TopologicalMap a = straight_walk(0.0, 3.0, 0.0);
  const TopologicalMap b = straight_walk(2.0, 6.0, 0.5);
  const TopologicalMap both = merged(a, b, is_any_way_free).value();
  EXPECT_EQ(both.vertices().size(), a.vertices().size() + b.vertices().size());
  EXPECT_GT(num_edges_between(both, a.vertices().size()), 0U);
  for (const TopologicalEdge& edge : both.edges()) {
    EXPECT_LE(both.distance_m(edge.from, edge.to), both.max_edge_m() + TopologicalMap::kRoundingM);
  }
  EXPECT_EQ(both.walk()->position_in_map, b.walk()->position_in_map);
  EXPECT_EQ(both.edges().size(),
            a.edges().size() + b.edges().size() + num_edges_between(both, a.vertices().size()));
}

TEST(MergedTopologicalMap, AWallOrADistanceKeepsThemApart) {
  const TopologicalMap a = straight_walk(0.0, 3.0, 0.0);
  const auto blocked = [](const Vector3d&, const Vector3d&) { return false; };
  const TopologicalMap beside = merged(a, straight_walk(0.0, 3.0, 0.5), blocked).value();
  EXPECT_EQ(num_edges_between(beside, a.vertices().size()), 0U);
  const TopologicalMap far = merged(a, straight_walk(0.0, 3.0, 1.0), is_any_way_free).value();
  EXPECT_EQ(num_edges_between(far, a.vertices().size()), 0U);
}

TEST(MergedTopologicalMap, AnEmptyOneChangesNothing) {
  const TopologicalMap a = straight_walk(0.0, 3.0, 0.0);
  EXPECT_EQ(merged(a, TopologicalMap(), is_any_way_free).value(), a);
  EXPECT_EQ(merged(TopologicalMap(), a, is_any_way_free).value(), a);
}

TEST(MergedTopologicalMap, OtherOptionsAreRefused) {
  const auto error =
      merged(TopologicalMap(), TopologicalMap({.vertex_distance_m = 2.0}), is_any_way_free).error();
  EXPECT_EQ(error.code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(error.field, "places");
}

}  // namespace
}  // namespace hypermap

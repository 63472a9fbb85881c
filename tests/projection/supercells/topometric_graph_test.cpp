// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/supercells/topometric_graph.hpp"

#include "stack_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

namespace hypermap {
namespace {

using test::cells_of;
using test::random_stack;
using test::stack_from;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kFar = std::numeric_limits<double>::infinity();

Supercells labelled(const GridGeometry& geometry, std::vector<std::int32_t> labels) {
  const int count = *std::ranges::max_element(labels) + 1;
  return {.geometry = geometry, .labels = std::move(labels), .count = count};
}

TEST(TopometricGraph, AHandWorkedOne) {
  // Cells of 0.1 m, row 0 below:   0 2 2 1
  //                                0 0 1 1
  // [sogm] Eq. (11): supercell 0 holds p = 0.8, 0.8, 0.5 on layer 0: odds 4 * 4 * 1 = 16, log-odds
  // 2.772 6, mean 0.924 2 (p = 0.715 9). Its centroid is that of (0.5, 0.5), (1.5, 0.5),
  // (0.5, 1.5): (0.833 3, 0.833 3) cells.
  const GridGeometry geometry = cells_of(4, 2);
  const std::vector<double> p0{0.8, 0.8, 0.2, 0.2, 0.5, 0.9, 0.9, 0.2};
  const GridStack stack = stack_from(geometry, 2, [&](int layer, Cell cell) {
    return layer == 0 ? p0[geometry.index(cell)] : 0.6;
  });
  const auto graph = topometric_graph(stack, labelled(geometry, {0, 0, 1, 1, 0, 2, 2, 1})).value();
  ASSERT_EQ(graph.nodes.size(), 3U);
  EXPECT_THAT(graph.layers, ElementsAre("/ism/0", "/ism/1"));
  EXPECT_EQ(graph.frame_id, "map");
  const SupercellNode& first = graph.nodes[0];
  EXPECT_EQ(first.num_cells, 3U);
  EXPECT_TRUE(first.centroid.isApprox(Eigen::Vector2d(0.25 / 3, 0.25 / 3), 1e-12));
  EXPECT_THAT(first.neighbours, ElementsAre(1, 2));
  EXPECT_NEAR(first.log_odds[0].value(), 2.7726, 1e-3);
  EXPECT_NEAR(first.mean[0].probability().value(), 0.7159, 1e-4);
  EXPECT_NEAR(first.log_odds[1].value(), 3 * 0.4055, 2e-3);
  EXPECT_THAT(graph.nodes[1].neighbours, ElementsAre(0, 2));
  EXPECT_THAT(graph.nodes[2].neighbours, ElementsAre(0, 1));
  EXPECT_EQ(best_layer(graph.nodes[0]), 0U);
  EXPECT_EQ(best_layer(graph.nodes[1]), 1U);
  EXPECT_EQ(best_layer(SupercellNode{.mean = {LogOdds(), LogOdds(-1.0)}}), std::nullopt);
}

TEST(TopometricGraph, LiesWhereTheStackDoes) {
  GridGeometry geometry = cells_of(2, 1);
  geometry.origin = {5.0, -1.0};
  geometry.yaw_rad = std::numbers::pi / 2;
  const GridStack stack = stack_from(geometry, 1, [](int, Cell) { return 0.6; });
  const auto graph = topometric_graph(stack, labelled(geometry, {0, 1})).value();
  // Turned by 90 degrees, the second cell's centre (0.15, 0.05) is at (-0.05, 0.15).
  EXPECT_TRUE(graph.nodes[1].centroid.isApprox(Eigen::Vector2d(4.95, -0.85), 1e-12));
}

TEST(TopometricGraph, EvidenceIsNeitherMadeNorLost) {
  // [sogm] Eq. (11): over all supercells the log-odds sum up to those of the layers.
  const GridStack stack = random_stack(cells_of(31, 17), 3, 9);
  const auto graph = topometric_graph(stack, extract_supercells(stack).value()).value();
  std::size_t layer = 0;
  for (const auto& [name, grid] : stack.layers()) {
    long steps = 0;
    for (const LogOddsSteps cell : grid.cells()) steps += cell;
    double sum = 0.0;
    for (const SupercellNode& node : graph.nodes) sum += node.log_odds[layer].value();
    EXPECT_NEAR(sum, static_cast<double>(steps) / 1000.0, 1e-9);
    ++layer;
  }
}

TEST(TopometricGraph, SupercellsAreFoundByClass) {
  const GridGeometry geometry = cells_of(3, 1);
  const GridStack stack =
      stack_from(geometry, 1, [](int /*layer*/, Cell cell) { return 0.3 + 0.3 * cell.col; });
  const auto graph = topometric_graph(stack, labelled(geometry, {0, 1, 2})).value();
  EXPECT_THAT(supercells_of(graph, "/ism/0").value(), ElementsAre(1, 2));
  EXPECT_THAT(supercells_of(graph, "/ism/0", Probability(0.8)).value(), ElementsAre(2));
  EXPECT_THAT(supercells_of(graph, "/ism/0", Probability(0.95)).value(), ElementsAre());
  const GridStack unknown =
      stack_from(geometry, 1, [](int /*layer*/, Cell cell) { return cell.col == 1 ? 0.6 : 0.5; });
  const auto partly_known = topometric_graph(unknown, labelled(geometry, {0, 1, 2})).value();
  EXPECT_THAT(supercells_of(partly_known, "/ism/0", Probability(0.2)).value(), ElementsAre(1));
  const auto failed = supercells_of(graph, "/ism/O");
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(failed.error().what, HasSubstr("there are: /ism/0"));
}

/// Distances between all pairs, by Floyd and Warshall.
std::vector<std::vector<double>> all_distances(const TopometricGraph& graph,
                                               const IsPassable& is_passable) {
  const std::size_t n = graph.nodes.size();
  std::vector<std::vector<double>> d(n, std::vector<double>(n, kFar));
  for (std::size_t i = 0; i < n; ++i) {
    d[i][i] = 0.0;
    for (const int k : graph.nodes[i].neighbours) {
      const auto& other = graph.nodes[static_cast<std::size_t>(k)];
      d[i][static_cast<std::size_t>(k)] = (other.centroid - graph.nodes[i].centroid).norm();
    }
  }
  for (std::size_t via = 0; via < n; ++via) {
    if (!is_passable(static_cast<int>(via))) continue;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t k = 0; k < n; ++k) d[i][k] = std::min(d[i][k], d[i][via] + d[via][k]);
    }
  }
  return d;
}

TEST(ShortestPath, IsTheShortestOfAllOnRandomGraphs) {
  const GridStack stack = random_stack(cells_of(40, 28), 1, 21);
  const auto found = extract_supercells(stack, {.num_levels = 2}).value();
  const auto graph = topometric_graph(stack, found).value();
  ASSERT_EQ(graph.nodes.size(), 70U);
  const IsPassable is_passable = [&graph](int number) {
    return graph.nodes[static_cast<std::size_t>(number)].mean[0].value() < 0.1;
  };
  const auto distances = all_distances(graph, is_passable);
  int num_without = 0;
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    for (std::size_t k = 0; k < graph.nodes.size(); ++k) {
      const auto path = shortest_path(graph, static_cast<int>(i), static_cast<int>(k), is_passable);
      ASSERT_EQ(path.has_value(), distances[i][k] < kFar);
      if (!path) {
        ++num_without;
        continue;
      }
      ASSERT_NEAR(path->length_m, distances[i][k], 1e-9);
      ASSERT_EQ(path->nodes.front(), static_cast<int>(i));
      ASSERT_EQ(path->nodes.back(), static_cast<int>(k));
      double length_m = 0.0;
      for (std::size_t j = 1; j < path->nodes.size(); ++j) {
        const auto& here = graph.nodes[static_cast<std::size_t>(path->nodes[j - 1])];
        const auto& next = graph.nodes[static_cast<std::size_t>(path->nodes[j])];
        ASSERT_TRUE(std::ranges::binary_search(here.neighbours, path->nodes[j]));
        length_m += (next.centroid - here.centroid).norm();
      }
      ASSERT_NEAR(length_m, path->length_m, 1e-9);
    }
  }
  EXPECT_GT(num_without, 0);  // some were cut off, or nothing was shown of that
}

TEST(ShortestPath, GoesAroundWhatIsNotPassable) {
  // 0 1 2 side by side below, 3 over all of them: not through 1 means over 3.
  const GridGeometry geometry = cells_of(3, 2);
  const GridStack stack = stack_from(geometry, 1, [](int /*layer*/, Cell cell) {
    return cell == Cell{1, 0} ? 0.9 : 0.2;
  });
  const auto graph = topometric_graph(stack, labelled(geometry, {0, 1, 2, 3, 3, 3})).value();
  EXPECT_THAT(shortest_path(graph, 0, 2)->nodes, ElementsAre(0, 1, 2));
  const IsPassable is_free = [&graph](int number) {
    return graph.nodes[static_cast<std::size_t>(number)].mean[0] < LogOdds();
  };
  const auto around = shortest_path(graph, 0, 2, is_free);
  EXPECT_THAT(around->nodes, ElementsAre(0, 3, 2));
  EXPECT_NEAR(around->length_m, 0.2 * std::numbers::sqrt2, 1e-12);
  EXPECT_THAT(shortest_path(graph, 1, 1, is_free)->nodes, ElementsAre(1));
  EXPECT_FALSE(shortest_path(graph, 0, 2, [](int) { return false; }));
}

TEST(UnknownSupercells, AreThoseOfWhichMostCellsNoLayerKnows) {
  // Cells: 0 0 0 | 1 1 | 2. The first layer knows a cell of 0, the second one a cell of 1.
  const GridGeometry geometry = cells_of(6, 1);
  const GridStack stack = stack_from(geometry, 2, [](int layer, Cell cell) {
    const bool is_known = (layer == 0 && cell.col == 0) || (layer == 1 && cell.col == 3);
    return is_known ? 0.3 : 0.5;
  });
  const Supercells supercells = labelled(geometry, {0, 0, 0, 1, 1, 2});
  EXPECT_THAT(unknown_supercells(stack, supercells).value(), ElementsAre(true, false, true));
  const GridStack other = random_stack(cells_of(3, 1), 1, 1);
  EXPECT_EQ(unknown_supercells(other, supercells).error().field, "supercells");
}

TEST(TopometricGraph, SupercellsOfAnotherStackAreRefused) {
  const GridStack stack = random_stack(cells_of(3, 1), 1, 1);
  EXPECT_EQ(topometric_graph(stack, labelled(cells_of(4, 1), {0, 0, 0, 0})).error().field,
            "supercells");
  EXPECT_FALSE(topometric_graph(stack, labelled(cells_of(3, 1), {0, 0})));
}

}  // namespace
}  // namespace hypermap

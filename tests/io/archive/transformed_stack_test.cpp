// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/grid_stack_layer.hpp"
#include "hypermap/io/archive/supercell_layer.hpp"
#include "hypermap/io/archive/transformed_map.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace hypermap {
namespace {

constexpr double kToleranceM = 1e-9;

TEST(TransformedMap, StacksAndSupercellsAnswerAtMovedPointsAsTheyDidBefore) {
  const GridGeometry geometry{.resolution_m = 0.25, .origin = {1, 2}, .cols = 2, .rows = 1};
  GridStack::Layers layers{{"/ism/cup", LogOddsGrid::create(geometry, {900, -900}).value()}};
  const GridStack stack = GridStack::create(geometry, {}, layers).value();
  const Supercells supercells{.geometry = geometry, .labels = {0, 1}, .count = 2};
  MapArchive map;
  ASSERT_TRUE(map.hypermap.add_layer({{.name = "stack"}, GridStackLayer(stack)}));
  ASSERT_TRUE(map.hypermap.add_layer(
      {{.name = "supercells"},
       SupercellLayer::create(supercells, topometric_graph(stack, supercells).value()).value()}));
  ASSERT_TRUE(map.hypermap.add_layer({{.name = "none"}, GridStackLayer()}));
  ASSERT_TRUE(map.hypermap.add_layer({{.name = "no cells"}, SupercellLayer()}));
  const Eigen::AngleAxisd quarter_turn(0.5 * std::numbers::pi, Eigen::Vector3d::UnitZ());
  const auto moved = transformed(map, MapFromOldMap(Eigen::Translation3d(10, 0, 0) * quarter_turn));
  ASSERT_TRUE(moved) << to_string(moved.error());
  // Cell (0, 0) has its centre at (1.125, 2.125): a quarter turn and 10 m take it to
  // (-2.125 + 10, 1.125).
  for (const char* name : {"stack", "supercells"}) {
    const auto here =
        moved->hypermap.find(name)->content->query({.at = PlanPoint{{7.875, 1.125}}}).value();
    ASSERT_EQ(here.size(), 1U) << name;
    EXPECT_EQ(here.front().name, "cup");
    EXPECT_LT((here.front().position - Eigen::Vector2d(7.875, 1.125)).norm(), kToleranceM);
  }
  const auto& graph = moved->hypermap.find_as<SupercellLayer>("supercells")->graph();
  EXPECT_LT((graph.nodes[1].centroid - Eigen::Vector2d(7.875, 1.375)).norm(), kToleranceM);
}

}  // namespace
}  // namespace hypermap

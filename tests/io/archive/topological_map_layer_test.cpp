// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/archive/topological_map_layer.hpp"

#include "hypermap/io/archive/archive_layers.hpp"
#include "projection/layers/layer_contract.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Path vertices at x = 0 and 0.95 m, support vertices at y = 0.95 and 1.9 m.
TopologicalMap two_ways() {
  TopologicalMap map;
  map.observe({0, 0, 1.25});
  map.observe({1.5, 0, 1.25});
  map.cover({0, 2, 1.25});
  return map;
}

std::vector<std::uint64_t> ids_of(const LayerQuery& query) {
  std::vector<std::uint64_t> ids;
  const TopologicalMapLayer layer(two_ways());
  const auto answers = layer.query(query);
  for (const LayerAnswer& answer : answers.value()) ids.push_back(answer.id);
  return ids;
}

TEST(TopologicalMapLayer, KeepsWhatHoldsForEveryType) {
  test::expect_layer_contract(TopologicalMapLayer(TopologicalMap()));
  test::expect_layer_contract(TopologicalMapLayer(two_ways()));
}

TEST(TopologicalMapLayer, AnswersByKindNumberPointAndArea) {
  EXPECT_THAT(ids_of({}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(ids_of({.text = "support"}), ElementsAre(2, 3));
  EXPECT_THAT(ids_of({.value = 3}), ElementsAre(3));
  EXPECT_THAT(ids_of({.at = PlanPoint{{0.8, 0.1}, {}}}), ElementsAre(1));
  EXPECT_THAT(ids_of({.at = PlanPoint{{0.8, 0.1}, 3.0}}), IsEmpty()) << "1.75 m above";
  const Polygon area = make_polygon({{-1, 0.5}, {1, 0.5}, {1, 3}, {-1, 3}}).value();
  EXPECT_THAT(ids_of({.area = area}), ElementsAre(2, 3));
}

// Three edges, two squares of path vertices, two crosses of support vertices.
TEST(TopologicalMapLayer, ItsEdgesAndVerticesAreDrawn) {
  const TopologicalMapLayer layer(two_ways());
  const auto drawn = layer.draw();
  ASSERT_THAT(drawn, SizeIs(3 + 2 + 2 * 2));
  const auto points_of = [&](std::size_t i) { return std::get<DrawnLine>(drawn[i]).points; };
  EXPECT_THAT(points_of(0), ElementsAre(Eigen::Vector2d(0, 0), Eigen::Vector2d(0.95, 0)));
  EXPECT_THAT(points_of(3), SizeIs(5)) << "a closed square";
  EXPECT_EQ(points_of(4).front(), points_of(4).back());
  EXPECT_THAT(points_of(5), SizeIs(2));
  EXPECT_TRUE((0.5 * (points_of(5)[0] + points_of(5)[1])).isApprox(Eigen::Vector2d(0, 0.95)));
  EXPECT_EQ(layer.statistics().num_values, 4U);
  EXPECT_EQ(layer.statistics().bounds->max(), Eigen::Vector3d(0.95, 1.9, 1.25));
}

TEST(TopologicalMapLayer, AnArchiveIsAskedForItByName) {
  MapArchive archive;
  EXPECT_FALSE(archive_layer(archive, kTopologicalMapLayer));
  archive.topological_map = two_ways();
  const auto layer = archive_layer(archive, "topological map");
  ASSERT_TRUE(layer) << to_string(layer.error());
  EXPECT_NE(layer->content.as<TopologicalMapLayer>(), nullptr);
  EXPECT_THAT(archive_layers(archive), IsEmpty());
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
// What the comparison of supercells is measured on: scenes have in them what they are said to have,
// and their sensors say what stands there, most of the time.
#include "table_top_scene.hpp"

#include "table_top_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace hypermap::test {
namespace {

constexpr std::uint64_t kSeed = 7;

class TableTop : public testing::TestWithParam<SceneKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, TableTop, testing::ValuesIn(kSceneKinds));

bool is_within(const Eigen::Vector2d& point) {
  const double side_m = kSceneSide * kSceneCellM;
  return point.minCoeff() > 0.0 && point.maxCoeff() < side_m;
}

TEST_P(TableTop, ObstaclesAreAtLeastEightCellsWideAndOnATable) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TableTopWorld world = table_top_world(GetParam(), seed);
    ASSERT_FALSE(world.obstacles.empty());
    for (const PlanShape& shape : world.obstacles) {
      const double half_side = shape.half_width > 0.0
                                   ? std::min(shape.half_length, shape.half_width)
                                   : shape.half_length;
      EXPECT_GE(2.0 * half_side, 8 * kSceneCellM - 1e-12);
      EXPECT_TRUE(world.is_on_table(shape.centre));
    }
  }
}

TEST_P(TableTop, RobotsStopOnTablesClearOfObstacles) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TableTopWorld world = table_top_world(GetParam(), seed);
    EXPECT_EQ(world.stops.size(), 80U);
    for (const Stop& stop : world.stops) {
      EXPECT_TRUE(is_within(stop.at));
      EXPECT_TRUE(world.is_on_table(stop.at));
      EXPECT_EQ(world.obstacle_at(stop.at), -1);
    }
  }
}

TEST(TableTopScenes, ASeedIsAScene) {
  const TableTopScene scene = table_top_scene(SceneKind::kOneTable, kSeed);
  const TableTopScene again = table_top_scene(SceneKind::kOneTable, kSeed);
  EXPECT_EQ(scene.stack, again.stack);
  EXPECT_EQ(scene.truth.labels, again.truth.labels);
  EXPECT_NE(scene.stack, table_top_scene(SceneKind::kOneTable, kSeed + 1).stack);
}

/// Of cells where a layer speaks for or against what it is about by a factor of e or more.
struct Agreement {
  std::size_t right = 0;
  std::size_t all = 0;
  [[nodiscard]] double share() const {
    return static_cast<double>(right) / static_cast<double>(all);
  }
};

/// How often a layer is above zero in cells of one true class.
Agreement positive_in(const TableTopScene& scene, const std::string& layer, TrueClass of_class) {
  const LogOddsGrid& grid = scene.stack.layers().at(layer);
  Agreement found;
  for (std::size_t i = 0; i < scene.truth.labels.size(); ++i) {
    const LogOddsSteps steps = grid.cells()[i];
    if (scene.truth.labels[i] != of_class || std::abs(steps) < 1000) continue;
    ++found.all;
    if (steps > 0) ++found.right;
  }
  return found;
}

/// The share of the cells of each true class that some layer speaks of.
std::array<double, 4> known_shares(const TableTopScene& scene) {
  std::array<std::size_t, 4> cells{};
  std::array<std::size_t, 4> known{};
  for (std::size_t i = 0; i < scene.truth.labels.size(); ++i) {
    const auto label = static_cast<std::size_t>(scene.truth.labels[i]);
    ++cells[label];
    const auto speaks = [&](const auto& layer) { return layer.second.cells()[i] != 0; };
    if (std::ranges::any_of(scene.stack.layers(), speaks)) ++known[label];
  }
  std::array<double, 4> shares{};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    shares[i] = static_cast<double>(known[i]) / static_cast<double>(cells[i]);
  }
  return shares;
}

TEST_P(TableTop, SensorsMostlySayWhatStandsThereAndNothingOfTheUnknown) {
  const TableTopScene scene = table_top_scene(GetParam(), kSeed);
  ASSERT_EQ(scene.stack.layers().size(), 3U);
  ASSERT_EQ(scene.truth.labels.size(), std::size_t{kSceneSide} * kSceneSide);
  EXPECT_EQ(scene.truth.count, 4);
  EXPECT_GT(positive_in(scene, "/ism/cam", kTable).share(), 0.75) << "obstacles hide some";
  EXPECT_LT(positive_in(scene, "/ism/cam", kFloor).share(), 0.1);
  EXPECT_GT(positive_in(scene, "/ism/edge", kFloor).share(), 0.9);
  EXPECT_LT(positive_in(scene, "/ism/edge", kTable).share(), 0.1);
  EXPECT_LT(positive_in(scene, "/ism/laser", kTable).share(), 0.1);
  EXPECT_GT(positive_in(scene, "/ism/laser", kObstacle).share(), 0.6);
  const std::array<double, 4> known = known_shares(scene);
  EXPECT_LT(known[kUnknown], 0.05);
  EXPECT_GT(known[kTable], 0.95);
  EXPECT_GT(known[kFloor], 0.9);
}

}  // namespace
}  // namespace hypermap::test

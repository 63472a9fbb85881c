// SPDX-License-Identifier: BSD-3-Clause
#include "table_top_world.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numbers>
#include <string_view>

namespace hypermap::test {
namespace {

using Eigen::Vector2d;

constexpr double kMiddle = kSceneSide * kSceneCellM / 2.0;
constexpr double kRobotRadius = 0.06;

Vector2d centre_of_cell(int col, int row) {
  return {(col + 0.5) * kSceneCellM, (row + 0.5) * kSceneCellM};
}

std::vector<PlanShape> tables_of(SceneKind kind, CounterRng& random) {
  const double yaw = random.uniform(-0.5, 0.5);
  const Vector2d middle(kMiddle + random.uniform(-0.3, 0.3), kMiddle + random.uniform(-0.3, 0.3));
  const auto table = [&](double length, double width, const Vector2d& offset) {
    return PlanShape{.centre = middle + Eigen::Rotation2Dd(yaw) * offset,
                     .half_length = length / 2.0,
                     .half_width = width / 2.0,
                     .yaw = yaw};
  };
  const double grow = random.uniform(0.9, 1.1);
  switch (kind) {
    case SceneKind::kOneTable:
      return {table(3.0 * grow, 2.0 * grow, {0.0, 0.0})};
    case SceneKind::kCornerTable:
      return {table(3.2 * grow, 1.2 * grow, {0.0, -0.7}),
              table(1.2 * grow, 2.6 * grow, {-1.0, 0.0})};
    case SceneKind::kTwoTables: {
      const double gap = random.uniform(0.3, 0.6);
      return {table(2.6 * grow, 1.4, {0.0, 0.7 + gap / 2.0}),
              table(2.6 * grow, 1.4, {random.uniform(-0.3, 0.3), -0.7 - gap / 2.0})};
    }
    case SceneKind::kCrowded:
      return {table(3.6 * grow, 2.6 * grow, {0.0, 0.0})};
  }
  return {};
}

/// A box, a disc or, in crowded scenes, something long and narrow. The smallest side is 8 cm.
PlanShape random_obstacle(SceneKind kind, CounterRng& random) {
  const double largest = kind == SceneKind::kCornerTable ? 0.2 : 0.35;
  const bool is_disc = random.chance(kind == SceneKind::kOneTable ? 0.2 : 0.5);
  const bool is_long = kind == SceneKind::kCrowded && random.chance(0.2);
  PlanShape shape{.half_length = random.uniform(0.08, largest) / 2.0,
                  .half_width = random.uniform(0.08, largest) / 2.0,
                  .yaw = random.uniform(0.0, std::numbers::pi),
                  .height = random.uniform(0.05, 0.35)};
  if (is_long) {
    shape.half_length = random.uniform(0.5, 1.0) / 2.0;
    shape.half_width = 0.04;
  } else if (is_disc) {
    shape.half_width = 0.0;
  }
  return shape;
}

/// A point of some table, at least `inset` from its edges.
Vector2d point_on(const std::vector<PlanShape>& tables, double inset, CounterRng& random) {
  const PlanShape& table = tables[random.below(static_cast<std::uint32_t>(tables.size()))];
  const Vector2d local(random.uniform(-1.0, 1.0) * (table.half_length - inset),
                       random.uniform(-1.0, 1.0) * (table.half_width - inset));
  return table.centre + Eigen::Rotation2Dd(table.yaw) * local;
}

std::uint32_t num_obstacles(SceneKind kind, CounterRng& random) {
  switch (kind) {
    case SceneKind::kOneTable:
      return 6 + random.below(4);
    case SceneKind::kCornerTable:
      return 12 + random.below(5);
    case SceneKind::kTwoTables:
      return 10 + random.below(5);
    case SceneKind::kCrowded:
      return 18 + random.below(7);
  }
  return 0;
}

}  // namespace

std::string_view name_of(SceneKind kind) {
  constexpr std::array<std::string_view, 4> kNames{
      "one table", "corner table", "two tables", "crowded"};
  return kNames[static_cast<std::size_t>(kind)];
}

TrueCells true_cells(const TableTopWorld& world) {
  TrueCells cells;
  for (int row = 0; row < kSceneSide; ++row) {
    for (int col = 0; col < kSceneSide; ++col) {
      const Vector2d point = centre_of_cell(col, row);
      cells.obstacle.push_back(static_cast<std::int16_t>(world.obstacle_at(point)));
      cells.is_table.push_back(world.is_on_table(point));
    }
  }
  return cells;
}

TableTopWorld table_top_world(SceneKind kind, std::uint64_t seed) {
  const auto scene = static_cast<std::uint64_t>(kind);
  CounterRng random(seed, scene, kShapes);
  TableTopWorld world{.tables = tables_of(kind, random)};
  const std::uint32_t count = num_obstacles(kind, random);
  for (std::uint32_t i = 0; i < count; ++i) {
    world.obstacles.push_back(random_obstacle(kind, random));
    world.obstacles.back().centre = point_on(world.tables, 0.1, random);
  }
  CounterRng marks(seed, scene, kMarks);
  for (std::uint32_t i = 0; i < 4 + marks.below(4); ++i) {
    world.marks.push_back({.centre = {marks.uniform(1.0, 5.0), marks.uniform(1.0, 5.0)},
                           .half_length = marks.uniform(0.02, 0.06)});
  }
  CounterRng stops(seed, scene, kStops);
  while (world.stops.size() < 80) {
    const Stop stop{point_on(world.tables, kRobotRadius, stops),
                    stops.uniform(-std::numbers::pi, std::numbers::pi)};
    const bool is_free = std::ranges::none_of(world.obstacles, [&](const PlanShape& shape) {
      return shape.holds(stop.at, kRobotRadius);
    });
    if (is_free) world.stops.push_back(stop);
  }
  return world;
}

}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What stands in a table-top scene: tables, obstacles on them, and where robots stop.
#pragma once

#include "table_top_scene.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap::test {

inline constexpr int kSceneSide = 600;  ///< Cells.
inline constexpr double kSceneCellM = 0.01;

/// What random numbers of a scene are for: a stream each.
enum SceneStream : std::uint64_t { kShapes = 1, kStops, kMounting, kReadings, kMarks, kTexture };

/// A box, or a disc when it has no second side. Unit: metre, radian.
struct PlanShape {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double half_length = 0.0;
  double half_width = 0.0;  ///< 0 for a disc.
  double yaw = 0.0;
  double height = 0.0;

  /// Whether the point is in it or within `margin` of its sides.
  [[nodiscard]] bool holds(const Eigen::Vector2d& point, double margin = 0.0) const {
    const Eigen::Vector2d local = Eigen::Rotation2Dd(-yaw) * (point - centre);
    if (half_width == 0.0) return local.norm() <= half_length + margin;
    return std::abs(local.x()) <= half_length + margin &&
           std::abs(local.y()) <= half_width + margin;
  }
};

struct Stop {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double yaw = 0.0;
};

struct TableTopWorld {
  std::vector<PlanShape> tables = {};
  std::vector<PlanShape> obstacles = {};
  std::vector<PlanShape> marks = {};  ///< What the camera takes for what it is not, each time.
  std::vector<Stop> stops = {};

  /// The obstacle there: its place, or -1.
  [[nodiscard]] int obstacle_at(const Eigen::Vector2d& point) const {
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      if (obstacles[i].holds(point)) return static_cast<int>(i);
    }
    return -1;
  }
  [[nodiscard]] bool is_on_table(const Eigen::Vector2d& point) const {
    return std::ranges::any_of(tables, [&](const PlanShape& table) { return table.holds(point); });
  }
};

/// The true class and obstacle of each cell: what rays ask.
struct TrueCells {
  std::vector<std::int16_t> obstacle;
  std::vector<bool> is_table;

  [[nodiscard]] static std::optional<std::size_t> place(const Eigen::Vector2d& point) {
    const int col = static_cast<int>(std::floor(point.x() / kSceneCellM));
    const int row = static_cast<int>(std::floor(point.y() / kSceneCellM));
    if (col < 0 || row < 0 || col >= kSceneSide || row >= kSceneSide) return std::nullopt;
    return static_cast<std::size_t>(row) * kSceneSide + static_cast<std::size_t>(col);
  }
};

[[nodiscard]] TrueCells true_cells(const TableTopWorld& world);

[[nodiscard]] TableTopWorld table_top_world(SceneKind kind, std::uint64_t seed);

}  // namespace hypermap::test

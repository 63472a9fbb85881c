// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Rooms whose walls and furniture are known exactly, and grids that sensors anywhere in them make.
#pragma once

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hypermap::test {

/// A rectangle, turned about its middle.
struct PlanBox {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d half = Eigen::Vector2d::Zero();
  double yaw_rad = 0.0;

  [[nodiscard]] bool contains(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d from = Eigen::Rotation2Dd(-yaw_rad) * (point - middle);
    return std::abs(from.x()) <= half.x() && std::abs(from.y()) <= half.y();
  }
};

/// From (0, 0) to `size`: walls of 0.15 m around, and what stands in it.
struct PlanRoom {
  Eigen::Vector2d size = Eigen::Vector2d::Zero();
  std::vector<PlanBox> furniture;

  [[nodiscard]] bool is_inside(const Eigen::Vector2d& p) const {
    return p.x() > -0.15 && p.y() > -0.15 && p.x() < size.x() + 0.15 && p.y() < size.y() + 0.15;
  }
  [[nodiscard]] bool is_occupied(const Eigen::Vector2d& p) const {
    const bool is_wall = p.x() < 0.0 || p.y() < 0.0 || p.x() > size.x() || p.y() > size.y();
    return is_wall ||
           std::ranges::any_of(furniture, [&](const PlanBox& b) { return b.contains(p); });
  }
};

inline PlanRoom furnished_room(std::uint64_t seed) {
  CounterRng random(seed, 1);
  PlanRoom room{{random.uniform(6.0, 9.0), random.uniform(5.0, 8.0)}, {}};
  for (int i = 0; i < 14; ++i) {
    room.furniture.push_back(
        {{random.uniform(0.0, room.size.x()), random.uniform(0.0, room.size.y())},
         {random.uniform(0.1, 0.6), random.uniform(0.1, 0.5)},
         random.uniform(0.0, 3.0)});
  }
  return room;
}

/// How a sensor's grid says what it sees.
struct SeenBy {
  double wrong_share = 0.0;  ///< Of the cells, that say the opposite.
  std::uint64_t seed = 0;
  double sureness = 1.0;  ///< Factor on the log-odds.
};

/// The room on the cells of a grid whose frame lies in the room so: each cell says how much of it
/// is occupied, of 9 places; outside the room it is unknown.
inline LogOddsGrid seen_room(const PlanRoom& room,
                             const GridGeometry& geometry,
                             const Eigen::Matrix3d& room_from_frame,
                             const SeenBy& seen = {}) {
  LogOddsGrid grid = LogOddsGrid::create(geometry).value();
  const CounterRng random(seen.seed, 2);
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      int num_occupied = 0;
      int num_inside = 0;
      for (int i = 0; i < 9; ++i) {
        const int below = i / 3;
        const Eigen::Vector2d part(col + (i % 3) / 3.0 + 1.0 / 6.0, row + below / 3.0 + 1.0 / 6.0);
        const Eigen::Vector2d place =
            (room_from_frame * from_cells(geometry, part).homogeneous()).hnormalized();
        num_inside += room.is_inside(place) ? 1 : 0;
        num_occupied += room.is_occupied(place) ? 1 : 0;
      }
      if (num_inside < 9) continue;
      const double l = seen.sureness * (-1.5 + 4.0 * num_occupied / 9.0);
      const bool is_wrong = random.uniform_at(geometry.index({col, row})) < seen.wrong_share;
      grid.set({col, row}, to_steps(LogOdds(is_wrong ? -l : l)));
    }
  }
  return grid;
}

inline Eigen::Matrix3d plane_pose(double x_m, double y_m, double yaw_rad, double scale = 1.0) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix.topLeftCorner<2, 2>() = scale * Eigen::Rotation2Dd(yaw_rad).toRotationMatrix();
  matrix.topRightCorner<2, 1>() = Eigen::Vector2d(x_m, y_m);
  return matrix;
}

/// The most that two homographies put any cell of the grid apart, in cells.
inline double most_apart(const Eigen::Matrix3d& a,
                         const Eigen::Matrix3d& b,
                         const GridGeometry& geometry) {
  double most = 0.0;
  for (int row = 0; row <= geometry.rows; row += 2) {
    for (int col = 0; col <= geometry.cols; col += 2) {
      const Eigen::Vector3d point = from_cells(geometry, Eigen::Vector2d(col, row)).homogeneous();
      const double apart = ((a * point).hnormalized() - (b * point).hnormalized()).norm();
      most = std::max(most, apart / geometry.resolution_m);
    }
  }
  return most;
}

}  // namespace hypermap::test

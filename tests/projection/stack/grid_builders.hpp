// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Grids of log-odds for tests.
#pragma once

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/projection/stack/log_odds_grid.hpp"

#include <Eigen/Geometry>

#include <utility>
#include <vector>

namespace hypermap::test {

inline GridGeometry sized(int cols, int rows, double resolution_m = 0.1) {
  return {.resolution_m = resolution_m, .cols = cols, .rows = rows};
}

inline LogOddsGrid grid_of(const GridGeometry& geometry, std::vector<LogOddsSteps> cells) {
  return LogOddsGrid::create(geometry, std::move(cells)).value();
}

/// Whole steps up to `max_steps` for and against; a fifth of the cells unknown.
inline LogOddsGrid random_grid(const GridGeometry& geometry, std::uint64_t seed, int max_steps) {
  CounterRng random(seed, 7);
  LogOddsGrid grid = LogOddsGrid::create(geometry).value();
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      const double steps = random.uniform(-max_steps, max_steps);
      if (!random.chance(0.2)) grid.set({col, row}, static_cast<LogOddsSteps>(steps));
    }
  }
  return grid;
}

/// As a homography.
inline Eigen::Matrix3d pose(double x_m, double y_m, double yaw_rad = 0.0) {
  Eigen::Isometry2d isometry = Eigen::Isometry2d::Identity();
  isometry.translate(Eigen::Vector2d(x_m, y_m));
  isometry.rotate(yaw_rad);
  return isometry.matrix();
}

inline long sum_of(const LogOddsGrid& grid) {
  long sum = 0;
  for (const LogOddsSteps steps : grid.cells()) sum += steps;
  return sum;
}

}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Grids that are drawn as text, for tests.
#pragma once

#include "hypermap/projection/grids/occupancy_grid.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap::test {

/// A plan by rows, the uppermost first: '.' free, '#' occupied, '?' unknown.
inline OccupancyGrid drawn_plan(const std::vector<std::string>& rows, double resolution_m = 1.0) {
  const GridGeometry geometry{.resolution_m = resolution_m,
                              .cols = static_cast<int>(rows.front().size()),
                              .rows = static_cast<int>(rows.size())};
  std::vector<std::int8_t> cells;
  cells.reserve(geometry.num_cells());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char one : *row) {
      cells.push_back(one == '#' ? kOccupiedCell : one == '?' ? kUnknownCell : kFreeCell);
    }
  }
  return OccupancyGrid::create(geometry, cells).value();
}

}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
#include "cell_lattice.hpp"

#include "hypermap/core/base/caught.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Rectangles of cells: from `first` to before `end`.
struct CellSpan {
  Cell first;
  Cell end;
};

CellSpan known_span(const LogOddsGrid& grid) {
  const GridGeometry& geometry = grid.geometry();
  CellSpan span{{geometry.cols, geometry.rows}, {0, 0}};
  for (int row = 0; row < geometry.rows; ++row) {
    for (int col = 0; col < geometry.cols; ++col) {
      if (grid.at({col, row}) == 0) continue;
      span.first = {std::min(span.first.col, col), std::min(span.first.row, row)};
      span.end = {std::max(span.end.col, col + 1), std::max(span.end.row, row + 1)};
    }
  }
  if (span.first.col < span.end.col) return span;
  const Cell middle{geometry.cols / 2, geometry.rows / 2};
  return {middle, {middle.col + 1, middle.row + 1}};
}

}  // namespace

Result<GridGeometry> lattice_around(const Rect& rect, double resolution_m) {
  const Eigen::Vector2d first = (rect.min / resolution_m).array().floor();
  const Eigen::Vector2d end = (rect.max / resolution_m).array().floor() + 1.0;
  constexpr double kMostCells = 1e9;  // more is refused by validate, whose numbers are ints
  const Eigen::Vector2d size = (end - first).cwiseMax(1.0).cwiseMin(kMostCells);
  const GridGeometry geometry{.resolution_m = resolution_m,
                              .origin = first * resolution_m,
                              .cols = static_cast<int>(size.x()),
                              .rows = static_cast<int>(size.y())};
  HYPERMAP_TRY(validate(geometry));
  return geometry;
}

Result<LogOddsGrid> cropped_to_known(const LogOddsGrid& grid) {
  const CellSpan span = known_span(grid);
  GridGeometry geometry = grid.geometry();
  geometry.origin = from_cells(grid.geometry(), Eigen::Vector2d(span.first.col, span.first.row));
  geometry.cols = span.end.col - span.first.col;
  geometry.rows = span.end.row - span.first.row;
  return guarded(ErrorCode::kInvalidArgument, "the grid", [&] {
    std::vector<LogOddsSteps> cells;
    cells.reserve(geometry.num_cells());
    for (int row = span.first.row; row < span.end.row; ++row) {
      for (int col = span.first.col; col < span.end.col; ++col)
        cells.push_back(grid.at({col, row}));
    }
    return LogOddsGrid::create(geometry, std::move(cells));
  });
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/near_cells.hpp"

#include "grids/clearance.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace hypermap {
namespace {

/// Cells around shapes, which may lie beyond the grid's edge.
struct Window {
  Cell first;  ///< Of the grid.
  GridGeometry geometry;
};

/// `margin_cells` around the polygons, as far as the grid is near. None when it is not.
std::optional<Window> window_around(const GridGeometry& grid,
                                    std::span<const Polygon> polygons,
                                    double margin_cells) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector2d high = -low;
  for (const Polygon& polygon : polygons) {
    for (const Eigen::Vector2d& corner : polygon.outer) {
      const Eigen::Vector2d cells = to_cells(grid, corner);
      low = low.cwiseMin(cells);
      high = high.cwiseMax(cells);
    }
  }
  const Eigen::Vector2d size(grid.cols, grid.rows);
  low = (low.array() - margin_cells).max(-margin_cells);
  high = (high.array() + margin_cells).min(size.array() + margin_cells);
  if (!((high - low).minCoeff() > 0.0)) return std::nullopt;
  const Eigen::Vector2d corner = low.array().floor();
  Window window{.first = {static_cast<int>(corner.x()), static_cast<int>(corner.y())},
                .geometry = grid};
  window.geometry.origin = from_cells(grid, corner);
  window.geometry.cols = static_cast<int>(std::ceil(high.x() - corner.x()));
  window.geometry.rows = static_cast<int>(std::ceil(high.y() - corner.y()));
  return window;
}

/// 0 where a polygon meets the cell.
CellMask mask_around(const GridGeometry& geometry, std::span<const Polygon> polygons) {
  CellMask around{.cols = geometry.cols,
                  .rows = geometry.rows,
                  .is_in = std::vector<std::uint8_t>(geometry.num_cells(), 1)};
  for (const Polygon& polygon : polygons) {
    for_each_covered_cell(
        geometry, polygon, [&](Cell cell, double) { around.is_in[geometry.index(cell)] = 0; });
  }
  return around;
}

}  // namespace

Result<void> for_each_near_cell(const GridGeometry& grid,
                                std::span<const Polygon> polygons,
                                double reach_cells,
                                const NearCellVisitor& visit) {
  const auto window = window_around(grid, polygons, std::ceil(reach_cells) + 2.0);
  if (!window) return {};
  HYPERMAP_TRY(validate(window->geometry));
  const std::vector<std::int64_t> distance =
      squared_clearance(mask_around(window->geometry, polygons), BeyondGrid::kIn);
  for (int row = 0; row < window->geometry.rows; ++row) {
    for (int col = 0; col < window->geometry.cols; ++col) {
      const Cell cell{window->first.col + col, window->first.row + row};
      const double gap = gap_in_cells(distance[window->geometry.index({col, row})]);
      if (gap <= reach_cells && grid.contains(cell)) visit(cell, gap);
    }
  }
  return {};
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where the cells of a grid lie in its frame: resolution, origin with yaw, columns and rows.
///
/// Source: [hypermap] 3.3.3 (occupancy layer): subtract the origin, turn back by its yaw, divide by
/// the resolution, round down.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <optional>

namespace hypermap {

/// A cell by column (along the grid's x) and row (along its y). Row 0 = min y.
struct Cell {
  int col = 0;
  int row = 0;
  friend auto operator<=>(const Cell&, const Cell&) = default;
};

/// Unit: metre, radian. Frame: that of the layer that owns the grid.
/// Shape: rows x cols, row-major, row 0 = min y.
struct GridGeometry {
  double resolution_m = 0.05;                        ///< Edge of a cell, 1e-6 to 1e3.
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< Lower-left corner of cell (0, 0).
  double yaw_rad = 0.0;                              ///< Turn of the grid about `origin`.
  int cols = 0;
  int rows = 0;

  [[nodiscard]] std::size_t num_cells() const noexcept {
    return static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows);
  }
  [[nodiscard]] bool contains(Cell cell) const noexcept {
    return cell.col >= 0 && cell.row >= 0 && cell.col < cols && cell.row < rows;
  }
  /// Place of a cell in row-major order. Requires: contains(cell).
  [[nodiscard]] std::size_t index(Cell cell) const noexcept {
    return static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(cols) +
           static_cast<std::size_t>(cell.col);
  }
  friend bool operator==(const GridGeometry&, const GridGeometry&) = default;
};

/// Errors: kInvalidArgument for a resolution outside 1e-6..1e3 m, an origin that is not finite or
/// beyond 1e6 m, a yaw that is not finite, a negative size; kLimit for a side over 65,535 or more
/// than 2^28 cells. Boundary: a grid without cells is valid.
[[nodiscard]] Result<void> validate(const GridGeometry& geometry);

/// The point in cells from the origin along the grid's axes: (0.5, 0.5) is the centre of cell (0,
/// 0).
[[nodiscard]] Eigen::Vector2d to_cells(const GridGeometry& geometry, const Eigen::Vector2d& point);
/// Inverse of to_cells.
[[nodiscard]] Eigen::Vector2d from_cells(const GridGeometry& geometry,
                                         const Eigen::Vector2d& cells);

/// The cell that holds the point; none outside the grid or for a point that is not finite.
/// Boundary: a point on a cell's lower or left edge belongs to it, on its upper or right edge to
/// the next one. Source: [hypermap] 3.3.3, occupancy layer.
[[nodiscard]] std::optional<Cell> cell_at(const GridGeometry& geometry,
                                          const Eigen::Vector2d& point);
/// Centre of a cell, inside the grid or not.
[[nodiscard]] Eigen::Vector2d centre(const GridGeometry& geometry, Cell cell);
/// The smallest axis-aligned rectangle of the frame around the grid.
[[nodiscard]] Rect bounds(const GridGeometry& geometry);

/// Called with a cell and the part of it that a polygon covers, in (0, 1].
using CoverageVisitor = std::function<void(Cell, double covered)>;

/// Visits the cells of the grid whose interior the polygon meets, row by row from row 0, columns
/// ascending, each with the covered part of its area, whatever the grid's yaw.
///
/// Boundary: a polygon that only touches a cell's edge does not meet it; parts below 1e-9 of a cell
/// count as none. What lies outside the grid is left out.
/// Cost: O(n log n + cells crossed by edges + cells visited) for n vertices; memory O(n + cols).
void for_each_covered_cell(const GridGeometry& geometry,
                           const Polygon& polygon,
                           const CoverageVisitor& visit);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/simulation_truth.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kMarginCells = 2;   // unknown cells around the room
constexpr double kSnap = 4096.0;  // steps a cell

/// The part of a convex polygon on one side of a height: `sign` 1 keeps what is above.
std::vector<Vector3d> cut_at(const std::vector<Vector3d>& polygon, double height_m, double sign) {
  std::vector<Vector3d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector3d& a = polygon[i];
    const Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double side_a = sign * (a.z() - height_m);
    const double side_b = sign * (b.z() - height_m);
    if (side_a >= 0.0) kept.push_back(a);
    if (side_a * side_b < 0.0) kept.emplace_back(a + side_a / (side_a - side_b) * (b - a));
  }
  return kept;
}

/// Coordinates in cells without the error of single precision, so that what lies on a cell's edge
/// does so exactly.
Vector2d snapped(const Vector2d& in_cells) {
  return (kSnap * in_cells).array().round().matrix() / kSnap;
}

/// Extent of points along a direction.
template <class Points>
std::pair<double, double> extent_along(const Points& points, const Vector2d& direction) {
  double low = points[0].dot(direction);
  double high = low;
  for (const Vector2d& point : points) {
    low = std::min(low, point.dot(direction));
    high = std::max(high, point.dot(direction));
  }
  return {low, high};
}

/// Separating axes of a convex polygon (perhaps a line) and a cell of edge 1 that holds its lower
/// and left edges, as `cell_at` has it.
bool intersects_cell(const std::vector<Vector2d>& polygon, Cell cell) {
  const Vector2d corner(cell.col, cell.row);
  for (const Vector2d& axis : {Vector2d(1, 0), Vector2d(0, 1)}) {
    const auto [low, high] = extent_along(polygon, axis);
    if (high < corner.dot(axis) || low >= corner.dot(axis) + 1.0) return false;
  }
  const std::array<Vector2d, 4> square{
      corner, corner + Vector2d(1, 0), corner + Vector2d(1, 1), corner + Vector2d(0, 1)};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const Vector2d axis(-edge.y(), edge.x());
    const auto [polygon_low, polygon_high] = extent_along(polygon, axis);
    const auto [cell_low, cell_high] = extent_along(square, axis);
    if (polygon_high < cell_low || cell_high < polygon_low) return false;
  }
  return true;
}

/// Marks the cells that a surface meets inside the band.
void mark_surface(const std::vector<Vector3d>& in_band, OccupancyGrid& grid) {
  if (in_band.size() < 2) return;
  std::vector<Vector2d> shadow;
  shadow.reserve(in_band.size());
  for (const Vector3d& point : in_band)
    shadow.push_back(snapped(to_cells(grid.geometry(), point.head<2>())));
  const auto [low_x, high_x] = extent_along(shadow, Vector2d::UnitX());
  const auto [low_y, high_y] = extent_along(shadow, Vector2d::UnitY());
  for (int row = static_cast<int>(std::floor(low_y)); row <= high_y; ++row) {
    for (int col = static_cast<int>(std::floor(low_x)); col <= high_x; ++col) {
      const Cell cell{col, row};
      if (grid.geometry().contains(cell) && intersects_cell(shadow, cell))
        grid.set(cell, kOccupiedCell);
    }
  }
}

void mark_mesh(const TriangleMesh& mesh, const TrueOccupancyOptions& options, OccupancyGrid& grid) {
  for (const auto& triangle : mesh.triangles) {
    std::vector<Vector3d> corners;
    corners.reserve(triangle.size());
    for (const std::uint32_t index : triangle)
      corners.push_back(mesh.vertices[index].cast<double>());
    const auto above = cut_at(corners, options.min_height_m, 1.0);
    mark_surface(cut_at(above, options.max_height_m, -1.0), grid);
  }
}

/// Frees the unknown cells that can be reached from `start` over cells that are not occupied.
void free_from(const Vector2d& start, OccupancyGrid& grid) {
  const auto first = cell_at(grid.geometry(), start);
  if (!first || grid.at(*first) != kUnknownCell) return;
  grid.set(*first, kFreeCell);
  std::vector<Cell> open{*first};
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    for (const Cell next : {Cell{cell.col - 1, cell.row},
                            Cell{cell.col + 1, cell.row},
                            Cell{cell.col, cell.row - 1},
                            Cell{cell.col, cell.row + 1}}) {
      if (!grid.geometry().contains(next) || grid.at(next) != kUnknownCell) continue;
      grid.set(next, kFreeCell);
      open.push_back(next);
    }
  }
}

/// A grid on whole multiples of the resolution around the room.
GridGeometry geometry_around(const Box& box, double resolution_m) {
  const Eigen::Array2d low =
      (box.min_in_map.head<2>().array() / resolution_m).floor() - static_cast<double>(kMarginCells);
  const Eigen::Array2d high =
      (box.max_in_map.head<2>().array() / resolution_m).ceil() + static_cast<double>(kMarginCells);
  GridGeometry geometry;
  geometry.resolution_m = resolution_m;
  geometry.origin = resolution_m * low.matrix();
  geometry.cols = static_cast<int>(high.x() - low.x());
  geometry.rows = static_cast<int>(high.y() - low.y());
  return geometry;
}

}  // namespace

Result<OccupancyGrid> true_occupancy(const FurnishedScene& scene,
                                     std::span<const CameraWaypoint> way,
                                     const TrueOccupancyOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_ASSIGN_OR_RETURN(
      OccupancyGrid grid,
      OccupancyGrid::create(geometry_around(bounds(scene.room), options.resolution_m)));
  mark_mesh(scene.room, options, grid);
  for (const PlacedObject& object : scene.objects) mark_mesh(object.mesh, options, grid);
  for (const CameraWaypoint& stop : way) free_from(stop.position_in_map.head<2>(), grid);
  return grid;
}

}  // namespace hypermap

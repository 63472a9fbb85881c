// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/grid_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace hypermap {
namespace {

constexpr double kMinResolution = 1e-6;
constexpr double kMaxResolution = 1e3;
constexpr double kMaxCoordinate = 1e6;
constexpr int kMaxSide = 65'535;
constexpr std::size_t kMaxCells = std::size_t{1} << 28U;

}  // namespace

Result<void> validate(const GridGeometry& geometry) {
  const double resolution = geometry.resolution_m;
  if (!(resolution >= kMinResolution && resolution <= kMaxResolution)) {
    return fail(ErrorCode::kInvalidArgument,
                "must be from 1e-6 to 1e3, is " + std::to_string(resolution),
                "resolution");
  }
  const Eigen::Vector2d& origin = geometry.origin;
  if (!origin.allFinite() || origin.cwiseAbs().maxCoeff() > kMaxCoordinate ||
      !std::isfinite(geometry.yaw_rad)) {
    return fail(ErrorCode::kInvalidArgument, "must be finite and within 1e6 m", "origin");
  }
  if (geometry.cols < 0 || geometry.rows < 0) {
    return fail(ErrorCode::kInvalidArgument, "a side must not be negative", "size");
  }
  if (geometry.cols > kMaxSide || geometry.rows > kMaxSide || geometry.num_cells() > kMaxCells) {
    return fail(ErrorCode::kLimit,
                std::to_string(geometry.cols) + " x " + std::to_string(geometry.rows) +
                    " cells, the limits are 65535 a side and 2^28 in all",
                "size");
  }
  return {};
}

Eigen::Vector2d to_cells(const GridGeometry& geometry, const Eigen::Vector2d& point) {
  const Eigen::Vector2d offset = point - geometry.origin;
  if (geometry.yaw_rad == 0.0) return offset / geometry.resolution_m;
  const double c = std::cos(geometry.yaw_rad);
  const double s = std::sin(geometry.yaw_rad);
  return Eigen::Vector2d(c * offset.x() + s * offset.y(), c * offset.y() - s * offset.x()) /
         geometry.resolution_m;
}

Eigen::Vector2d from_cells(const GridGeometry& geometry, const Eigen::Vector2d& cells) {
  const Eigen::Vector2d offset = cells * geometry.resolution_m;
  if (geometry.yaw_rad == 0.0) return geometry.origin + offset;
  const double c = std::cos(geometry.yaw_rad);
  const double s = std::sin(geometry.yaw_rad);
  return geometry.origin +
         Eigen::Vector2d(c * offset.x() - s * offset.y(), s * offset.x() + c * offset.y());
}

std::optional<Cell> cell_at(const GridGeometry& geometry, const Eigen::Vector2d& point) {
  const Eigen::Vector2d cells = to_cells(geometry, point);
  const bool inside = cells.x() >= 0 && cells.y() >= 0 && cells.x() < geometry.cols &&
                      cells.y() < geometry.rows;  // false for NaN
  if (!inside) return std::nullopt;
  return Cell{static_cast<int>(cells.x()), static_cast<int>(cells.y())};
}

Eigen::Vector2d centre(const GridGeometry& geometry, Cell cell) {
  return from_cells(geometry, {cell.col + 0.5, cell.row + 0.5});
}

Rect bounds(const GridGeometry& geometry) {
  Rect rect{geometry.origin, geometry.origin};
  const double cols = geometry.cols;
  const double rows = geometry.rows;
  for (const Eigen::Vector2d& corner :
       {Eigen::Vector2d(cols, 0), Eigen::Vector2d(0, rows), Eigen::Vector2d(cols, rows)}) {
    const Eigen::Vector2d point = from_cells(geometry, corner);
    rect.min = rect.min.cwiseMin(point);
    rect.max = rect.max.cwiseMax(point);
  }
  return rect;
}

}  // namespace hypermap

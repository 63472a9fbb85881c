// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/tile_lattice.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

constexpr std::size_t kMaxFrameBytes = 256;
constexpr int kMaxTileCells = 4096;
constexpr double kFarthestPoint = 1e6;  // in metres
constexpr double kFarthestTile = 1e9;

double origin_of(std::int32_t tile, const TileLattice& lattice) {
  const std::int64_t cells = std::int64_t{tile} * lattice.tile_cells;
  return static_cast<double>(cells) * lattice.resolution_m;
}

int side_of(int tiles, const TileLattice& lattice) {
  const std::int64_t cells = std::int64_t{tiles} * lattice.tile_cells;
  return static_cast<int>(std::min<std::int64_t>(cells, std::numeric_limits<int>::max()));
}

}  // namespace

Result<void> validate(const TileLattice& lattice) {
  const std::size_t frame_bytes = lattice.frame_id.size();
  if (frame_bytes == 0 || frame_bytes > kMaxFrameBytes) {
    return fail(ErrorCode::kInvalidArgument,
                "must have 1 to 256 bytes, has " + std::to_string(frame_bytes),
                "frame_id");
  }
  if (lattice.tile_cells < 1 || lattice.tile_cells > kMaxTileCells) {
    return fail(ErrorCode::kInvalidArgument,
                "must be from 1 to 4096, is " + std::to_string(lattice.tile_cells),
                "tile_cells");
  }
  return validate(GridGeometry{.resolution_m = lattice.resolution_m});
}

bool TileWindow::contains(TileIndex tile) const noexcept {
  const std::int64_t col = std::int64_t{tile.col} - first.col;
  const std::int64_t row = std::int64_t{tile.row} - first.row;
  return col >= 0 && row >= 0 && col < cols && row < rows;
}

Result<GridGeometry> geometry_of(const TileLattice& lattice, const TileWindow& window) {
  const GridGeometry geometry{
      .resolution_m = lattice.resolution_m,
      .origin = {origin_of(window.first.col, lattice), origin_of(window.first.row, lattice)},
      .cols = side_of(window.cols, lattice),
      .rows = side_of(window.rows, lattice)};
  HYPERMAP_TRY(validate(geometry));
  return geometry;
}

Result<TileWindow> window_around(const TileLattice& lattice,
                                 const Eigen::Vector2d& point,
                                 int cols,
                                 int rows) {
  if (!point.allFinite() || point.cwiseAbs().maxCoeff() > kFarthestPoint) {
    return fail(ErrorCode::kInvalidArgument,
                "must be finite and within 1e6 m, is " + number_text(point.x()) + ", " +
                    number_text(point.y()),
                "point");
  }
  const Eigen::Vector2d half(cols / 2.0, rows / 2.0);
  const Eigen::Vector2d first =
      (point / lattice.tile_m() - half + Eigen::Vector2d::Constant(0.5)).array().floor();
  if (first.cwiseAbs().maxCoeff() > kFarthestTile) {
    return fail(ErrorCode::kLimit,
                "lies " + number_text(first.cwiseAbs().maxCoeff()) +
                    " tiles from the origin, the limit is 10^9",
                "point");
  }
  return TileWindow{
      .first = {static_cast<std::int32_t>(first.x()), static_cast<std::int32_t>(first.y())},
      .cols = cols,
      .rows = rows};
}

}  // namespace hypermap

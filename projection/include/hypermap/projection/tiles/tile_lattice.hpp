// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the plane of a frame is cut into tiles of whole cells.
///
/// Source: [sogm] III-E, figure 8.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"

#include <Eigen/Core>

#include <compare>
#include <cstdint>
#include <string>

namespace hypermap {

/// A tile by how many tiles it lies from the origin of its frame, along x and along y.
struct TileIndex {
  std::int32_t col = 0;
  std::int32_t row = 0;
  friend auto operator<=>(const TileIndex&, const TileIndex&) = default;
};

/// Square tiles that lie side by side; a corner of one is the origin of the frame.
///
/// Places are whole numbers of cells, and metres one product of these: nothing is added up that
/// could drift.
struct TileLattice {
  std::string frame_id = "map";  ///< In which the tiles lie.
  double resolution_m = 0.05;    ///< Edge of a cell.
  int tile_cells = 200;          ///< Of a tile's side, 1 to 4096.

  [[nodiscard]] double tile_m() const noexcept { return tile_cells * resolution_m; }
  friend bool operator==(const TileLattice&, const TileLattice&) = default;
};

/// Errors: kInvalidArgument for a frame without a name or with one of more than 256 bytes, a
/// resolution outside 1e-6 to 1e3 m, a number of cells outside 1 to 4096.
[[nodiscard]] Result<void> validate(const TileLattice& lattice);

/// A rectangle of tiles: `cols` x `rows` from `first` on.
struct TileWindow {
  TileIndex first = {};
  int cols = 1;
  int rows = 1;

  [[nodiscard]] bool contains(TileIndex tile) const noexcept;
  friend bool operator==(const TileWindow&, const TileWindow&) = default;
};

/// Where the cells of the window lie. Errors: those of validate(GridGeometry): too many cells, or
/// too far from the origin. Requires: the lattice is valid, cols and rows are 1 or more.
[[nodiscard]] Result<GridGeometry> geometry_of(const TileLattice& lattice,
                                               const TileWindow& window);

/// The window of this size whose middle is nearest to the point.
/// Errors: kInvalidArgument when the point is not finite or farther than 1e6 m from the origin;
/// kLimit when it lies more than 10^9 tiles away. Boundary: of two such windows the upper one.
[[nodiscard]] Result<TileWindow> window_around(const TileLattice& lattice,
                                               const Eigen::Vector2d& point,
                                               int cols,
                                               int rows);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which points lie near a set of points.
#pragma once

#include "geometry/floor_of.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace hypermap {

/// A cell of a proximity grid: floor(p / near_m) on each axis.
struct ProximityCell {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
  friend bool operator==(const ProximityCell&, const ProximityCell&) = default;
};

[[nodiscard]] inline ProximityCell proximity_cell_of(const Eigen::Vector3d& p, double near_m) {
  return {floor_of(p.x() / near_m), floor_of(p.y() / near_m), floor_of(p.z() / near_m)};
}

/// Lowest and highest coordinates of cells.
struct ProximityBounds {
  ProximityCell low;
  ProximityCell high;
};
/// Requires: not empty.
[[nodiscard]] ProximityBounds bounds_of(std::span<const ProximityCell> cells);

/// A set of cells and all that touch them, one bit for each cell of their bounds.
class DenseNeighbourhood {
 public:
  /// What the bits would take. Unit: words of 8 bytes.
  [[nodiscard]] static double num_words(const ProximityBounds& bounds);
  /// Requires: `bounds` are those of `cells`; num_words(bounds) can be allocated.
  DenseNeighbourhood(std::span<const ProximityCell> cells, const ProximityBounds& bounds);

  [[nodiscard]] bool contains(const ProximityCell& cell) const {
    const std::uint64_t x = steps(origin_.x, cell.x);
    const std::uint64_t y = steps(origin_.y, cell.y);
    const std::uint64_t z = steps(origin_.z, cell.z);
    if (x >= size_x_ || y >= size_y_ || z >= 64 * words_per_row_) return false;
    return (bits_[(x * size_y_ + y) * words_per_row_ + z / 64] >> z % 64 & 1U) != 0;
  }

 private:
  /// From one coordinate to another; backwards it wraps around to a large number.
  [[nodiscard]] static std::uint64_t steps(std::int64_t from, std::int64_t to) {
    return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
  }
  void spread();

  ProximityCell origin_;  ///< One cell before the lowest.
  std::uint64_t size_x_;  ///< Of the bounds with a margin of one cell on each side.
  std::uint64_t size_y_;
  std::uint64_t words_per_row_;      ///< A row is all cells of one x and y, from the lowest z on.
  std::vector<std::uint64_t> bits_;  ///< Row after row, by x, then y.
};

/// A set of cells: tiles in a hash table, each 8 x 8 cells as the bits of a word.
class CellTiles {
 public:
  void mark(std::uint64_t key, std::uint64_t cells);
  /// 0 when nothing of the tile is marked.
  [[nodiscard]] std::uint64_t cells(std::uint64_t key) const { return tiles_[slot_of(key)].cells; }

 private:
  struct Tile {
    std::uint64_t key = 0;
    std::uint64_t cells = 0;  ///< No bit: the slot is free.
  };
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;

  std::vector<Tile> tiles_ = std::vector<Tile>(64);  ///< Open addressing, at most half full.
  std::size_t num_tiles_ = 0;
};

/// The same set, for cells that lie far apart: memory by the number of cells.
///
/// Marks the cells and their neighbours along y and z, so that a query reads three tiles.
class SparseNeighbourhood {
 public:
  SparseNeighbourhood() = default;
  explicit SparseNeighbourhood(std::span<const ProximityCell> cells);
  [[nodiscard]] bool contains(const ProximityCell& cell) const;

 private:
  void mark_around(std::int64_t x, std::int64_t tile_y, std::int64_t tile_z, std::uint64_t cells);

  CellTiles near_;
};

/// The cells that points fall into; what lies in one of them or next to one is near: points up to
/// the edge of a cell away always, those beyond twice that never.
///
/// The cells of a grid and those that it is asked for are of one edge.
class ProximityGrid {
 public:
  ProximityGrid() = default;
  /// Cost: O(cells), and a bit for each cell of their bounds where those are not much more.
  explicit ProximityGrid(std::span<const ProximityCell> cells);

  [[nodiscard]] bool is_near(const ProximityCell& cell) const;
  /// Of `cells`, those that are near; 0 when there are none.
  [[nodiscard]] double share_near(std::span<const ProximityCell> cells) const;

 private:
  std::variant<SparseNeighbourhood, DenseNeighbourhood> near_;
};

}  // namespace hypermap

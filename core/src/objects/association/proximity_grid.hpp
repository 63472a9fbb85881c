// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which points lie near a set of points.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

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

/// The cells that points fall into; what lies in one of them or next to one is near.
///
/// Marks the cells and their neighbours along y and z, so that a query reads three tiles.
class ProximityGrid {
 public:
  /// Points up to `near_m` away are near, those beyond twice that never. Requires: near_m > 0.
  ProximityGrid(std::span<const Eigen::Vector3d> points, double near_m);

  [[nodiscard]] bool is_near(const Eigen::Vector3d& point) const;
  /// Of `points`, those that are near; 0 when there are none.
  [[nodiscard]] double share_near(std::span<const Eigen::Vector3d> points) const;

 private:
  void mark_around(std::int64_t x, std::int64_t tile_y, std::int64_t tile_z, std::uint64_t cells);

  double near_m_;
  CellTiles near_;
};

}  // namespace hypermap

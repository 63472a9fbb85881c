// SPDX-License-Identifier: BSD-3-Clause
#include "proximity_grid.hpp"

#include "geometry/floor_of.hpp"

#include <array>
#include <utility>

namespace hypermap {
namespace {

struct Cell {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

Cell cell_of(const Eigen::Vector3d& p, double edge_m) {
  return {floor_of(p.x() / edge_m), floor_of(p.y() / edge_m), floor_of(p.z() / edge_m)};
}

/// A tile's place: x, y / 8, z / 8. 24 and twice 20 bits: tiles eight million cells apart share a
/// key, which no two objects are.
std::uint64_t key_of(std::int64_t x, std::int64_t tile_y, std::int64_t tile_z) {
  const auto bits = [](std::int64_t i, unsigned count) {
    return static_cast<std::uint64_t>(i) & ((std::uint64_t{1} << count) - 1U);
  };
  return bits(x, 24) << 40U | bits(tile_y, 20) << 20U | bits(tile_z, 20);
}

std::uint64_t key_of(const Cell& cell) {
  return key_of(cell.x, cell.y >> 3, cell.z >> 3);
}

/// The bit of a cell within its tile.
std::uint64_t bit_of(const Cell& cell) {
  return std::uint64_t{1} << static_cast<unsigned>((cell.y & 7) * 8 + (cell.z & 7));
}

/// What a tile's cells and their neighbours along z are in the tile before, in it and after it.
std::array<std::uint64_t, 3> spread_along_z(std::uint64_t cells) {
  constexpr std::uint64_t kFirst = 0x0101'0101'0101'0101ULL;
  return {(cells & kFirst) << 7U,
          cells | (cells & ~(kFirst << 7U)) << 1U | (cells & ~kFirst) >> 1U,
          (cells >> 7U) & kFirst};
}

/// The same along y.
std::array<std::uint64_t, 3> spread_along_y(std::uint64_t cells) {
  return {cells << 56U, cells | cells << 8U | cells >> 8U, cells >> 56U};
}

}  // namespace

std::size_t CellTiles::slot_of(std::uint64_t key) const {
  const std::size_t mask = tiles_.size() - 1;
  // The upper bits of the product: only they depend on all of the key.
  std::size_t slot = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 44U) & mask;
  while (tiles_[slot].cells != 0 && tiles_[slot].key != key) slot = (slot + 1) & mask;
  return slot;
}

void CellTiles::mark(std::uint64_t key, std::uint64_t cells) {
  if (cells == 0) return;
  std::size_t slot = slot_of(key);
  if (tiles_[slot].cells == 0 && 2 * ++num_tiles_ > tiles_.size()) {
    const std::vector<Tile> old = std::exchange(tiles_, std::vector<Tile>(4 * tiles_.size()));
    for (const Tile& tile : old) {
      if (tile.cells != 0) tiles_[slot_of(tile.key)] = tile;
    }
    slot = slot_of(key);
  }
  tiles_[slot].key = key;
  tiles_[slot].cells |= cells;
}

ProximityGrid::ProximityGrid(std::span<const Eigen::Vector3d> points, double near_m)
    : near_m_(near_m) {
  // Points in a row are mostly neighbours: each tile is written once for all of them.
  Cell place;
  std::uint64_t cells = 0;
  for (const Eigen::Vector3d& point : points) {
    const Cell cell = cell_of(point, near_m_);
    const Cell tile{cell.x, cell.y >> 3, cell.z >> 3};
    if (tile != place) {
      mark_around(place.x, place.y, place.z, std::exchange(cells, 0));
      place = tile;
    }
    cells |= bit_of(cell);
  }
  mark_around(place.x, place.y, place.z, cells);
}

void ProximityGrid::mark_around(std::int64_t x,
                                std::int64_t tile_y,
                                std::int64_t tile_z,
                                std::uint64_t cells) {
  const auto along_z = spread_along_z(cells);
  for (std::size_t i = 0; i < along_z.size(); ++i) {
    const auto along_y = spread_along_y(along_z[i]);
    for (std::size_t k = 0; k < along_y.size(); ++k) {
      near_.mark(key_of(x,
                        tile_y + static_cast<std::int64_t>(k) - 1,
                        tile_z + static_cast<std::int64_t>(i) - 1),
                 along_y[k]);
    }
  }
}

bool ProximityGrid::is_near(const Eigen::Vector3d& point) const {
  const Cell c = cell_of(point, near_m_);
  const std::uint64_t bit = bit_of(c);
  const auto is_marked = [&](std::int64_t dx) {
    return (near_.cells(key_of({c.x + dx, c.y, c.z})) & bit) != 0;
  };
  return is_marked(0) || is_marked(-1) || is_marked(1);
}

double ProximityGrid::share_near(std::span<const Eigen::Vector3d> points) const {
  if (points.empty()) return 0.0;
  std::size_t num_near = 0;
  for (const Eigen::Vector3d& p : points) num_near += is_near(p) ? 1U : 0U;
  return static_cast<double>(num_near) / static_cast<double>(points.size());
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "proximity_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// Dense cells may take so many words, and so many more for each cell.
constexpr double kLeastWords = 4096.0;
constexpr double kWordsPerCell = 4.0;

/// A tile's place: x, y / 8, z / 8. 24 and twice 20 bits: tiles eight million cells apart share a
/// key, which no two objects are.
std::uint64_t key_of(std::int64_t x, std::int64_t tile_y, std::int64_t tile_z) {
  const auto bits = [](std::int64_t i, unsigned count) {
    return static_cast<std::uint64_t>(i) & ((std::uint64_t{1} << count) - 1U);
  };
  return bits(x, 24) << 40U | bits(tile_y, 20) << 20U | bits(tile_z, 20);
}

std::uint64_t key_of(const ProximityCell& cell) {
  return key_of(cell.x, cell.y >> 3, cell.z >> 3);
}

/// The bit of a cell within its tile.
std::uint64_t bit_of(const ProximityCell& cell) {
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

SparseNeighbourhood::SparseNeighbourhood(std::span<const ProximityCell> cells) {
  // Cells in a row are mostly neighbours: each tile is written once for all of them.
  ProximityCell place;
  std::uint64_t marked = 0;
  for (const ProximityCell& cell : cells) {
    const ProximityCell tile{cell.x, cell.y >> 3, cell.z >> 3};
    if (tile != place) {
      mark_around(place.x, place.y, place.z, std::exchange(marked, 0));
      place = tile;
    }
    marked |= bit_of(cell);
  }
  mark_around(place.x, place.y, place.z, marked);
}

void SparseNeighbourhood::mark_around(std::int64_t x,
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

bool SparseNeighbourhood::contains(const ProximityCell& cell) const {
  const std::uint64_t bit = bit_of(cell);
  const auto is_marked = [&](std::int64_t dx) {
    return (near_.cells(key_of({cell.x + dx, cell.y, cell.z})) & bit) != 0;
  };
  return is_marked(0) || is_marked(-1) || is_marked(1);
}

ProximityBounds bounds_of(std::span<const ProximityCell> cells) {
  ProximityBounds bounds{cells.front(), cells.front()};
  for (const auto& [x, y, z] : cells) {
    bounds.low = {std::min(bounds.low.x, x), std::min(bounds.low.y, y), std::min(bounds.low.z, z)};
    bounds.high = {
        std::max(bounds.high.x, x), std::max(bounds.high.y, y), std::max(bounds.high.z, z)};
  }
  return bounds;
}

double DenseNeighbourhood::num_words(const ProximityBounds& bounds) {
  const auto size = [](std::int64_t low, std::int64_t high) {
    return static_cast<double>(high) - static_cast<double>(low) + 3.0;
  };
  return size(bounds.low.x, bounds.high.x) * size(bounds.low.y, bounds.high.y) *
         std::ceil(size(bounds.low.z, bounds.high.z) / 64.0);
}

DenseNeighbourhood::DenseNeighbourhood(std::span<const ProximityCell> cells,
                                       const ProximityBounds& bounds)
    : origin_{bounds.low.x - 1, bounds.low.y - 1, bounds.low.z - 1},
      size_x_(static_cast<std::uint64_t>(bounds.high.x - bounds.low.x) + 3),
      size_y_(static_cast<std::uint64_t>(bounds.high.y - bounds.low.y) + 3),
      words_per_row_((static_cast<std::uint64_t>(bounds.high.z - bounds.low.z) + 3 + 63) / 64),
      bits_(size_x_ * size_y_ * words_per_row_, 0) {
  for (const ProximityCell& cell : cells) {
    const std::uint64_t x = steps(origin_.x, cell.x);
    const std::uint64_t y = steps(origin_.y, cell.y);
    const std::uint64_t z = steps(origin_.z, cell.z);
    bits_[(x * size_y_ + y) * words_per_row_ + z / 64] |= std::uint64_t{1} << z % 64;
  }
  spread();
}

/// To the neighbours along z, then y, then x. Nothing reaches around to another row or plane: the
/// margins between them are empty on the axis that is spread along.
void DenseNeighbourhood::spread() {
  const std::size_t n = bits_.size();
  std::vector<std::uint64_t> along_z(bits_);
  for (std::size_t i = 0; i < n; ++i) along_z[i] |= bits_[i] << 1U | bits_[i] >> 1U;
  for (std::size_t i = 1; i < n; ++i) {
    along_z[i] |= bits_[i - 1] >> 63U;
    along_z[i - 1] |= bits_[i] << 63U;
  }
  const auto spread_by = [n](const std::vector<std::uint64_t>& from, std::size_t step) {
    std::vector<std::uint64_t> to(from);
    for (std::size_t i = step; i < n; ++i) to[i] |= from[i - step];
    for (std::size_t i = step; i < n; ++i) to[i - step] |= from[i];
    return to;
  };
  bits_ = spread_by(spread_by(along_z, words_per_row_), size_y_ * words_per_row_);
}

ProximityGrid::ProximityGrid(std::span<const ProximityCell> cells) {
  if (cells.empty()) return;
  const ProximityBounds bounds = bounds_of(cells);
  const double most_words = kLeastWords + kWordsPerCell * static_cast<double>(cells.size());
  if (DenseNeighbourhood::num_words(bounds) <= most_words) {
    near_ = DenseNeighbourhood(cells, bounds);
  } else {
    near_ = SparseNeighbourhood(cells);
  }
}

bool ProximityGrid::is_near(const ProximityCell& cell) const {
  return std::visit([&](const auto& near) { return near.contains(cell); }, near_);
}

double ProximityGrid::share_near(std::span<const ProximityCell> cells) const {
  if (cells.empty()) return 0.0;
  const auto num_near = std::visit(
      [&](const auto& near) {
        return std::count_if(
            cells.begin(), cells.end(), [&](const auto& cell) { return near.contains(cell); });
      },
      near_);
  return static_cast<double>(num_near) / static_cast<double>(cells.size());
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "grids/room_regions.hpp"

#include "grids/cell_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace hypermap {
namespace {

/// Sets of regions that were found to be one.
class RegionSets {
 public:
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  [[nodiscard]] std::uint32_t root_of(std::uint32_t region) {
    while (parent_[region] != region) {
      parent_[region] = parent_[parent_[region]];
      region = parent_[region];
    }
    return region;
  }
  /// The first one stays the root. Requires: roots.
  void unite(std::uint32_t kept, std::uint32_t other) { parent_[other] = kept; }
  [[nodiscard]] std::size_t size() const noexcept { return parent_.size(); }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Numbers the roots that cells have from 0 on, in the order of their first cells.
RoomRegions numbered(std::vector<std::uint32_t> cells,
                     RegionSets& sets,
                     const std::vector<std::int64_t>& clearance) {
  RoomRegions regions;
  std::vector<std::uint32_t> number_of(sets.size(), kNoRegion);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == kNoRegion) continue;
    std::uint32_t& number = number_of[sets.root_of(cells[i])];
    if (number == kNoRegion) {
      number = static_cast<std::uint32_t>(regions.widest.size());
      regions.widest.push_back(i);
      regions.num_cells.push_back(0);
    }
    cells[i] = number;
    ++regions.num_cells[number];
    if (clearance[i] > clearance[regions.widest[number]]) regions.widest[number] = i;
  }
  regions.cells = std::move(cells);
  return regions;
}

class Flood {
 public:
  Flood(const CellMask& mask,
        const std::vector<std::int64_t>& clearance,
        double resolution_m,
        const RoomOptions& options)
      : mask_(mask),
        clearance_(clearance),
        resolution_m_(resolution_m),
        options_(options),
        cells_(clearance.size(), kNoRegion) {}

  RoomRegions run() {
    for (const std::size_t cell : downwards()) cells_[cell] = region_of(cell);
    return numbered(std::move(cells_), sets_, clearance_);
  }

 private:
  [[nodiscard]] std::vector<std::size_t> downwards() const {
    std::vector<std::size_t> order;
    order.reserve(clearance_.size());
    for (std::size_t i = 0; i < clearance_.size(); ++i) {
      if (mask_.is_in[i] != 0) order.push_back(i);
    }
    std::ranges::stable_sort(
        order, [&](std::size_t a, std::size_t b) { return clearance_[a] > clearance_[b]; });
    return order;
  }

  [[nodiscard]] double peak_m(std::uint32_t region) const {
    return gap_width_m(peaks_[region], resolution_m_);
  }

  /// Whether a gap between two regions, in whose middle `cell` is, parts rooms. Requires: roots.
  [[nodiscard]] bool is_parting(std::size_t cell, std::uint32_t a, std::uint32_t b) {
    const double gap_m = gap_width_m(clearance_[cell], resolution_m_);
    const double narrower_m = std::min(peak_m(a), peak_m(b));
    if (gap_m >= options_.doorway_m || narrower_m < options_.min_width_m) return false;
    if (gap_m < options_.passage_share * narrower_m) return true;
    const double needed_m = gap_m / options_.max_gap_share;
    return widens_to(needed_m, cell, a) && widens_to(needed_m, cell, b);
  }

  /// Whether a region is wider than that somewhere within a doorway's depth of a cell.
  [[nodiscard]] bool widens_to(double width_m, std::size_t cell, std::uint32_t region) {
    const auto width = static_cast<std::size_t>(mask_.cols);
    const auto all = static_cast<double>(std::max(mask_.cols, mask_.rows));
    const auto reach = static_cast<int>(std::min(options_.doorway_depth_m / resolution_m_, all));
    const int row = static_cast<int>(cell / width);
    const int col = static_cast<int>(cell % width);
    for (int r = std::max(row - reach, 0); r <= std::min(row + reach, mask_.rows - 1); ++r) {
      for (int c = std::max(col - reach, 0); c <= std::min(col + reach, mask_.cols - 1); ++c) {
        const std::size_t at = static_cast<std::size_t>(r) * width + static_cast<std::size_t>(c);
        const bool is_wide =
            cells_[at] != kNoRegion && gap_width_m(clearance_[at], resolution_m_) > width_m;
        if (is_wide && sets_.root_of(cells_[at]) == region) return true;
      }
    }
    return false;
  }

  /// The region of a cell: that of its neighbour with the largest clearance, so that no region
  /// creeps along a wall. The regions of all neighbours become one where nothing parts them.
  std::uint32_t region_of(std::size_t cell) {
    std::vector<std::size_t> around;
    for_each_neighbour(mask_.cols, mask_.rows, cell, [&](std::size_t next) {
      if (cells_[next] != kNoRegion) around.push_back(next);
    });
    if (around.empty()) {
      peaks_.push_back(clearance_[cell]);
      return sets_.add();
    }
    for (const std::size_t a : around) {
      for (const std::size_t b : around) {
        unite_unless_parted(cell, sets_.root_of(cells_[a]), sets_.root_of(cells_[b]));
      }
    }
    const auto upward = std::ranges::max_element(
        around, [&](std::size_t a, std::size_t b) { return clearance_[a] < clearance_[b]; });
    return sets_.root_of(cells_[*upward]);
  }

  /// The wider one stays, so that the root of a set knows its widest place. Requires: roots.
  void unite_unless_parted(std::size_t cell, std::uint32_t a, std::uint32_t b) {
    if (a == b || is_parting(cell, a, b)) return;
    peaks_[a] >= peaks_[b] ? sets_.unite(a, b) : sets_.unite(b, a);
  }

  const CellMask& mask_;
  const std::vector<std::int64_t>& clearance_;
  double resolution_m_;
  const RoomOptions& options_;
  std::vector<std::uint32_t> cells_;
  std::vector<std::int64_t> peaks_;  ///< Of each region that was begun its largest clearance.
  RegionSets sets_;
};

/// The largest clearance in the gap to each neighbour of a region.
using Gaps = std::map<std::uint32_t, std::int64_t>;

void widen(Gaps& gaps, std::uint32_t neighbour, std::int64_t clearance) {
  std::int64_t& widest = gaps[neighbour];
  widest = std::max(widest, clearance);
}

std::vector<Gaps> gaps_of(const RoomRegions& regions,
                          const CellMask& mask,
                          const std::vector<std::int64_t>& clearance) {
  std::vector<Gaps> gaps(regions.num_cells.size());
  for (std::size_t i = 0; i < regions.cells.size(); ++i) {
    const std::uint32_t here = regions.cells[i];
    if (here == kNoRegion) continue;
    for_each_neighbour(mask.cols, mask.rows, i, [&](std::size_t next) {
      const std::uint32_t other = regions.cells[next];
      if (other == here || other == kNoRegion) return;
      widen(gaps[here], other, std::min(clearance[i], clearance[next]));
    });
  }
  return gaps;
}

/// The neighbour with the widest gap, of equal ones the first. Requires: there is one.
std::uint32_t widest_of(const Gaps& gaps) {
  return std::ranges::max_element(gaps, {}, [](const auto& gap) { return gap.second; })->first;
}

/// `gone` is a part of its neighbour `kept`.
std::vector<Gaps> with_united(std::vector<Gaps> gaps, std::uint32_t kept, std::uint32_t gone) {
  for (const auto& [other, clearance] : gaps[gone]) {
    gaps[other].erase(gone);
    if (other == kept) continue;
    widen(gaps[kept], other, clearance);
    widen(gaps[other], kept, clearance);
  }
  gaps[gone].clear();
  return gaps;
}

}  // namespace

double gap_width_m(std::int64_t squared_clearance, double resolution_m) {
  return (2.0 * std::sqrt(static_cast<double>(squared_clearance)) - 1.0) * resolution_m;
}

RoomRegions flood_regions(const CellMask& mask,
                          const std::vector<std::int64_t>& clearance,
                          double resolution_m,
                          const RoomOptions& options) {
  return Flood(mask, clearance, resolution_m, options).run();
}

RoomRegions without_niches(RoomRegions regions,
                           const CellMask& mask,
                           const std::vector<std::int64_t>& clearance,
                           std::size_t min_cells) {
  std::vector<Gaps> gaps = gaps_of(regions, mask, clearance);
  std::vector<std::size_t> sizes = regions.num_cells;
  std::vector<std::uint8_t> is_dropped(sizes.size(), 0);
  RegionSets sets;
  std::set<std::pair<std::size_t, std::uint32_t>> by_size;
  for (const std::size_t size : sizes) by_size.emplace(size, sets.add());
  while (!by_size.empty() && by_size.begin()->first < min_cells) {
    const std::uint32_t niche = by_size.begin()->second;
    by_size.erase(by_size.begin());
    if (gaps[niche].empty()) {
      is_dropped[niche] = 1;
      continue;
    }
    const std::uint32_t kept = widest_of(gaps[niche]);
    by_size.erase({sizes[kept], kept});
    sizes[kept] += sizes[niche];
    by_size.emplace(sizes[kept], kept);
    sets.unite(kept, niche);
    gaps = with_united(std::move(gaps), kept, niche);
  }
  for (std::uint32_t& cell : regions.cells) {
    if (cell == kNoRegion) continue;
    cell = sets.root_of(cell);
    if (is_dropped[cell] != 0) cell = kNoRegion;
  }
  return numbered(std::move(regions.cells), sets, clearance);
}

}  // namespace hypermap

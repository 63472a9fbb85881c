// SPDX-License-Identifier: BSD-3-Clause
#include "grids/room_regions.hpp"

#include "grids/cell_neighbours.hpp"

#include <algorithm>
#include <cmath>
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

  /// Whether a gap between two regions parts rooms. Requires: roots.
  [[nodiscard]] bool is_parting(double gap_m, std::uint32_t a, std::uint32_t b) const {
    const double narrower_m = std::min(peak_m(a), peak_m(b));
    return narrower_m >= options_.doorway_m && gap_m < options_.doorway_m &&
           gap_m < options_.max_gap_share * narrower_m;
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
    const double gap_m = gap_width_m(clearance_[cell], resolution_m_);
    for (const std::size_t a : around) {
      for (const std::size_t b : around) {
        unite_unless_parted(gap_m, sets_.root_of(cells_[a]), sets_.root_of(cells_[b]));
      }
    }
    const auto upward = std::ranges::max_element(
        around, [&](std::size_t a, std::size_t b) { return clearance_[a] < clearance_[b]; });
    return sets_.root_of(cells_[*upward]);
  }

  /// The wider one stays, so that the root of a set knows its widest place. Requires: roots.
  void unite_unless_parted(double gap_m, std::uint32_t a, std::uint32_t b) {
    if (a == b || is_parting(gap_m, a, b)) return;
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
  for (;;) {
    const auto smallest = std::ranges::min_element(regions.num_cells);
    if (smallest == regions.num_cells.end() || *smallest >= min_cells) return regions;
    const auto niche = static_cast<std::uint32_t>(smallest - regions.num_cells.begin());
    std::int64_t widest = -1;
    std::uint32_t neighbour = kNoRegion;
    for (std::size_t i = 0; i < regions.cells.size(); ++i) {
      if (regions.cells[i] != niche) continue;
      for_each_neighbour(mask.cols, mask.rows, i, [&](std::size_t next) {
        const std::uint32_t other = regions.cells[next];
        if (other == niche || other == kNoRegion || clearance[i] <= widest) return;
        widest = clearance[i];
        neighbour = other;
      });
    }
    RegionSets sets;
    for (std::size_t i = 0; i < regions.num_cells.size(); ++i) sets.add();
    std::ranges::replace(regions.cells, niche, neighbour);
    regions = numbered(std::move(regions.cells), sets, clearance);
  }
}

}  // namespace hypermap

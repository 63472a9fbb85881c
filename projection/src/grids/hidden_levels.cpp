// SPDX-License-Identifier: BSD-3-Clause
#include "grids/hidden_levels.hpp"

#include "grids/cell_neighbours.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

constexpr int kMaxLevels = 62;
/// Leaves are on an octree's lattice: so much of a level beside another is rounding.
constexpr double kSlackLevels = 1e-6;
/// Where more than that of a column is occupied in a row, it is no edge of a level surface.
constexpr double kMaxEdgeM = 0.15;
/// More that was not seen between free levels is what no picture reached.
constexpr double kMaxHiddenM = 0.2;
/// So far a surface goes on beside what was measured of it.
constexpr double kReachM = 0.15;

std::uint64_t ones(int count) {
  return (std::uint64_t{1} << count) - 1;
}

/// The runs of ones of `levels` that are no longer than so many.
std::uint64_t short_runs(std::uint64_t levels, int most) {
  std::uint64_t kept = 0;
  while (levels != 0) {
    const int begin = std::countr_zero(levels);
    const int length = std::countr_one(levels >> begin);
    if (length <= most) kept |= ones(length) << begin;
    levels &= ~(ones(length) << begin);
  }
  return kept;
}

/// What lies between the lowest and the highest of `levels` and is none of them.
std::uint64_t between(std::uint64_t levels) {
  if (levels == 0) return 0;
  return ones(64 - std::countl_zero(levels)) & ~ones(std::countr_zero(levels)) & ~levels;
}

int whole_levels(double length_m, double level_edge_m) {
  return static_cast<int>(std::floor(length_m / level_edge_m + kSlackLevels));
}

}  // namespace

HiddenLevels::HiddenLevels(const GridGeometry& geometry,
                           const HeightBand& band,
                           double level_edge_m)
    : geometry_(geometry), level_edge_m_(level_edge_m) {
  while ((band.max_m - band.min_m) > (kMaxLevels - 1) * level_edge_m_) level_edge_m_ *= 2.0;
  first_ = std::floor(band.min_m / level_edge_m_ + kSlackLevels);
  num_levels_ = static_cast<int>(std::ceil(band.max_m / level_edge_m_ - kSlackLevels) - first_);
  free_.resize(geometry.num_cells());
  occupied_.resize(geometry.num_cells());
}

std::uint64_t HiddenLevels::levels_of(const LeafSample& leaf) const {
  const double low = (leaf.centre_in_map.z() - leaf.edge_m / 2) / level_edge_m_ - first_;
  const double high = low + leaf.edge_m / level_edge_m_;
  if (!(high > 0.0 && low < num_levels_)) return 0;
  const int begin = static_cast<int>(std::floor(std::max(low + kSlackLevels, 0.0)));
  const int end = static_cast<int>(std::ceil(std::min<double>(high - kSlackLevels, num_levels_)));
  return end > begin ? ones(end - begin) << begin : 0;
}

void HiddenLevels::add(Cell cell, const LeafSample& leaf, std::uint64_t levels) {
  (leaf.occupied ? occupied_ : free_)[geometry_.index(cell)] |= levels;
}

// From here on `free_` has the levels that a surface beside a cell would hide, `occupied_` those at
// which a surface goes on.
std::vector<HiddenLevels::Front> HiddenLevels::find_edges() {
  const int most_hidden = whole_levels(kMaxHiddenM, level_edge_m_);
  const int most_of_edge = whole_levels(kMaxEdgeM, level_edge_m_);
  std::vector<Front> edges;
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const std::uint64_t edge = short_runs(occupied_[i], most_of_edge);
    free_[i] = occupied_[i] == 0 ? short_runs(between(free_[i]), most_hidden) : 0;
    occupied_[i] = edge | (edge << 1) | (edge >> 1);
    if (edge != 0) edges.push_back({.cell = i, .levels = occupied_[i]});
  }
  return edges;
}

std::vector<bool> HiddenLevels::take_hidden_cells() && {
  std::vector<Front> front = find_edges();
  std::vector<bool> hides(free_.size(), false);
  for (int left = whole_levels(kReachM, geometry_.resolution_m); left > 0; --left) {
    std::vector<Front> next;
    for (const Front& from : front) {
      for_each_neighbour(geometry_.cols, geometry_.rows, from.cell, [&](std::size_t beside) {
        const std::uint64_t hidden = free_[beside] & from.levels;
        if (hidden == 0) return;
        free_[beside] &= ~hidden;
        hides[beside] = true;
        next.push_back({.cell = beside, .levels = hidden});
      });
    }
    front = std::move(next);
  }
  return hides;
}

}  // namespace hypermap

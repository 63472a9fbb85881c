// SPDX-License-Identifier: BSD-3-Clause
#include "binned_cells.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace hypermap {
namespace {

/// 2 k + 1 of the bin of a probability, which is below 1 (kMaxLogOddsSteps): the last bin is
/// closed.
std::uint16_t bin_value(LogOddsSteps steps, int num_bins) {
  const double p = from_steps(steps).probability().value();
  const int bin = static_cast<int>(p * num_bins);
  return static_cast<std::uint16_t>(2 * bin + 1);
}

/// Of all steps, from the least on: so that no cell needs an exponential.
std::vector<std::uint16_t> bin_value_table(int num_bins) {
  std::vector<std::uint16_t> table;
  table.reserve(2U * kMaxLogOddsSteps + 1U);
  for (int steps = -kMaxLogOddsSteps; steps <= kMaxLogOddsSteps; ++steps) {
    table.push_back(bin_value(static_cast<LogOddsSteps>(steps), num_bins));
  }
  return table;
}

HistogramSums with(const HistogramSums& a, const HistogramSums& b, int sign) {
  return {a.sum + sign * b.sum, a.sum_of_squares + sign * b.sum_of_squares};
}

double variance_of_layer(const HistogramSums& sums, double num_cells) {
  const double mean = static_cast<double>(sums.sum) / num_cells;
  return static_cast<double>(sums.sum_of_squares) / num_cells - mean * mean;
}

/// From values 2 k + 1 to bin centres (2 k + 1) / (2 K).
double scaled(double variance_of_values, int num_bins) {
  return variance_of_values / (4.0 * num_bins * num_bins);
}

}  // namespace

BinnedCells binned(const GridStack& stack, int num_bins) {
  const GridGeometry& geometry = stack.geometry();
  const std::size_t num_layers = stack.layers().size();
  const std::vector<std::uint16_t> value_of = bin_value_table(num_bins);
  BinnedCells cells{.cols = geometry.cols,
                    .rows = geometry.rows,
                    .num_layers = static_cast<int>(num_layers),
                    .num_bins = num_bins,
                    .values = std::vector<std::uint16_t>(num_layers * geometry.num_cells())};
  std::size_t layer = 0;
  for (const auto& [name, grid] : stack.layers()) {
    for (std::size_t i = 0; i < grid.cells().size(); ++i) {
      const int place = grid.cells()[i] + kMaxLogOddsSteps;
      cells.values[i * num_layers + layer] = value_of[static_cast<std::size_t>(place)];
    }
    ++layer;
  }
  return cells;
}

void add_cells(CellSums& set, const CellSums& more) {
  set.num_cells += more.num_cells;
  for (std::size_t i = 0; i < set.layers.size(); ++i) {
    set.layers[i] = with(set.layers[i], more.layers[i], 1);
  }
}

void remove_cells(CellSums& set, const CellSums& less) {
  set.num_cells -= less.num_cells;
  for (std::size_t i = 0; i < set.layers.size(); ++i) {
    set.layers[i] = with(set.layers[i], less.layers[i], -1);
  }
}

void add_cell(CellSums& set, std::span<const std::uint16_t> values) {
  ++set.num_cells;
  for (std::size_t i = 0; i < set.layers.size(); ++i) {
    const std::int64_t value = values[i];
    set.layers[i] = with(set.layers[i], {value, value * value}, 1);
  }
}

double variance_with(const CellSums& set, const CellSums& other, int sign, int num_bins) {
  const std::int64_t count = set.num_cells + sign * other.num_cells;
  assert(count > 0);
  double sum = 0.0;
  for (std::size_t i = 0; i < set.layers.size(); ++i) {
    const HistogramSums layer = with(set.layers[i], other.layers[i], sign);
    sum += variance_of_layer(layer, static_cast<double>(count));
  }
  return scaled(sum, num_bins);
}

double variance_of(const CellSums& set, int num_bins) {
  double sum = 0.0;
  for (const HistogramSums& layer : set.layers) {
    sum += variance_of_layer(layer, static_cast<double>(set.num_cells));
  }
  return scaled(sum, num_bins);
}

bool has_no_variance(const CellSums& set) {
  return std::ranges::all_of(set.layers, [&](const HistogramSums& layer) {
    const std::int64_t mean = layer.sum / set.num_cells;
    return mean * set.num_cells == layer.sum && mean * layer.sum == layer.sum_of_squares;
  });
}

}  // namespace hypermap

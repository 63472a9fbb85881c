// SPDX-License-Identifier: BSD-3-Clause
#include "binned_cells.hpp"

#include <algorithm>
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

/// n^2 times the sum of the layers' variances of values, from n, the sum of squares and, on each
/// layer, the sum. Whole numbers below 2^53 are exact.
double scatter_of_values(double num_cells, double sum_of_squares, double square_of_sums) {
  return num_cells * sum_of_squares - square_of_sums;
}

/// From values 2 k + 1 to bin centres (2 k + 1) / (2 K).
double to_centres(double variance_of_values, int num_bins) {
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

void CellSums::clear(std::size_t set) {
  std::ranges::fill(std::span(sums_).subspan(set * stride_, stride_), 0);
}

void CellSums::add_cell(std::size_t set, std::span<const std::uint16_t> values) {
  std::int64_t* sums = &sums_[set * stride_];
  ++sums[0];
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::int64_t value = values[i];
    sums[1] += value * value;
    sums[i + 2] += value;
  }
}

void CellSums::add(std::size_t set, SetSums more) {
  for (std::size_t i = 0; i < stride_; ++i) sums_[set * stride_ + i] += more[i];
}

void CellSums::remove(std::size_t set, SetSums less) {
  for (std::size_t i = 0; i < stride_; ++i) sums_[set * stride_ + i] -= less[i];
}

double variance_of(SetSums set, int num_bins) {
  double square_of_sums = 0.0;
  for (const std::int64_t sum : set.subspan(2)) {
    square_of_sums += static_cast<double>(sum) * static_cast<double>(sum);
  }
  const auto count = static_cast<double>(set[0]);
  assert(count > 0.0);
  const double scatter = scatter_of_values(count, static_cast<double>(set[1]), square_of_sums);
  return to_centres(scatter / (count * count), num_bins);
}

double variance_with(SetSums set, SetSums other, int sign, int num_bins) {
  double square_of_sums = 0.0;
  for (std::size_t i = 2; i < set.size(); ++i) {
    const auto sum = static_cast<double>(set[i] + sign * other[i]);
    square_of_sums += sum * sum;
  }
  const auto count = static_cast<double>(set[0] + sign * other[0]);
  assert(count > 0.0);
  const auto squares = static_cast<double>(set[1] + sign * other[1]);
  const double scatter = scatter_of_values(count, squares, square_of_sums);
  return to_centres(scatter / (count * count), num_bins);
}

bool has_no_variance(SetSums set) {
  // On each layer the sum of squares is at least n times the squared mean, and only then as much.
  std::int64_t least_squares = 0;
  for (const std::int64_t sum : set.subspan(2)) {
    const std::int64_t mean = sum / set[0];
    if (mean * set[0] != sum) return false;
    least_squares += mean * sum;
  }
  return least_squares == set[1];
}

}  // namespace hypermap

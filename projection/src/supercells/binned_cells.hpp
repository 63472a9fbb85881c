// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Probabilities of a stack by bins, and the variance of their marginal histograms.
///
/// Source: [sogm] Eq. (8) to (10).
#pragma once

#include "hypermap/projection/stack/grid_stack.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Count and sums of the cells in a histogram of one layer. A bin k has its centre at
/// (2 k + 1) / (2 K): sums are those of 2 k + 1, which are whole.
struct HistogramSums {
  std::int64_t sum = 0;
  std::int64_t sum_of_squares = 0;
  friend bool operator==(const HistogramSums&, const HistogramSums&) = default;
};

/// The marginal histograms of one set of cells, as far as their variances need them.
struct CellSums {
  std::int64_t num_cells = 0;
  std::vector<HistogramSums> layers;
  friend bool operator==(const CellSums&, const CellSums&) = default;
};

/// 2 k + 1 of the bin of each cell on each layer.
struct BinnedCells {
  int cols = 0;
  int rows = 0;
  int num_layers = 0;
  int num_bins = 0;
  std::vector<std::uint16_t> values;  ///< Layers of a cell side by side.

  [[nodiscard]] std::span<const std::uint16_t> of_cell(std::size_t cell) const {
    const auto n = static_cast<std::size_t>(num_layers);
    return std::span(values).subspan(cell * n, n);
  }
};

/// Layers in the order of their names. Bin k is [k/K, (k+1)/K), the last one closed.
[[nodiscard]] BinnedCells binned(const GridStack& stack, int num_bins);

/// With the cells of `more`; without those of `less`, which it has. Requires: equal layers.
void add_cells(CellSums& set, const CellSums& more);
void remove_cells(CellSums& set, const CellSums& less);
void add_cell(CellSums& set, std::span<const std::uint16_t> values);

/// D' of Eq. (10) of the set with `sign` times the cells of `other` (0, 1 or -1), whose layers may
/// be none when the sign is 0. Requires: some cells are left.
[[nodiscard]] double variance_with(const CellSums& set,
                                   const CellSums& other,
                                   int sign,
                                   int num_bins);
[[nodiscard]] double variance_of(const CellSums& set, int num_bins);
/// Exactly: whether all cells lie in one bin of each layer.
[[nodiscard]] bool has_no_variance(const CellSums& set);

}  // namespace hypermap

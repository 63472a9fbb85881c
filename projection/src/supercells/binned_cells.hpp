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

/// 2 k + 1 of the bin of each cell on each layer: a bin k has its centre at (2 k + 1) / (2 K), and
/// sums of these are whole.
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

/// The marginal histograms of a set of cells, as far as their variances need them: how many cells;
/// the sum of squares of their values, over all layers; the sum of values on each layer.
using SetSums = std::span<const std::int64_t>;

/// Sums of many sets, side by side in memory; all empty at first.
class CellSums {
 public:
  CellSums() = default;
  CellSums(std::size_t num_sets, int num_layers)
      : stride_(static_cast<std::size_t>(num_layers) + 2), sums_(num_sets * stride_, 0) {}

  [[nodiscard]] SetSums of(std::size_t set) const {
    return std::span(sums_).subspan(set * stride_, stride_);
  }
  [[nodiscard]] std::int64_t num_cells(std::size_t set) const { return sums_[set * stride_]; }
  void clear(std::size_t set);
  void add_cell(std::size_t set, std::span<const std::uint16_t> values);
  /// With the cells of `more`; without those of `less`, which it has. Requires: equal layers.
  void add(std::size_t set, SetSums more);
  void remove(std::size_t set, SetSums less);

 private:
  std::size_t stride_ = 0;
  std::vector<std::int64_t> sums_;
};

/// D' of Eq. (10). Requires: some cells.
[[nodiscard]] double variance_of(SetSums set, int num_bins);
/// Of the set with `sign` times the cells of `other` (1 or -1). Requires: some cells are left.
[[nodiscard]] double variance_with(SetSums set, SetSums other, int sign, int num_bins);
/// Exactly: whether all cells lie in one bin of each layer. Requires: some cells.
[[nodiscard]] bool has_no_variance(SetSums set);

}  // namespace hypermap

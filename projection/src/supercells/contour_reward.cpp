// SPDX-License-Identifier: BSD-3-Clause
#include "contour_reward.hpp"

#include <algorithm>
#include <array>

namespace hypermap {
namespace {

constexpr int kReach = 2;  // of a block's patches beyond the block

/// How many cells of a patch's side lie within [begin, end).
int num_within(int middle, int begin, int end) {
  return std::max(std::min(middle + 2, end) - std::max(middle - 1, begin), 0);
}

/// The sum of squared shares of labels in the patch around a cell.
double patch_reward(std::span<const std::int32_t> labels, int cols, int rows, int col, int row) {
  std::array<std::int32_t, 9> patch{};
  std::size_t n = 0;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, rows - 1); ++y) {
    for (int x = std::max(col - 1, 0); x <= std::min(col + 1, cols - 1); ++x) {
      patch[n++] = labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(cols) +
                          static_cast<std::size_t>(x)];
    }
  }
  const auto end = patch.begin() + static_cast<std::ptrdiff_t>(n);
  if (std::all_of(patch.begin(), end, [&](std::int32_t label) { return label == patch[0]; })) {
    return 1.0;
  }
  std::size_t num_equal = n;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = i + 1; k < n; ++k) num_equal += patch[i] == patch[k] ? 2U : 0U;
  }
  return static_cast<double>(num_equal) / static_cast<double>(n * n);
}

}  // namespace

double contour_reward(int cols, int rows, std::span<const std::int32_t> labels) {
  double sum = 0.0;
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) sum += patch_reward(labels, cols, rows, col, row);
  }
  return sum;
}

ContourPull::ContourPull(int cols, int rows, int level)
    : cols_(cols), by_col_(sides_of(cols, level)), by_row_(sides_of(rows, level)) {}

std::vector<ContourPull::Side> ContourPull::sides_of(int num_cells, int level) {
  std::vector<Side> sides;
  for (int begin = 0; begin < num_cells; begin += 1 << level) {
    const int end = std::min(begin + (1 << level), num_cells);
    const int first = std::max(begin - kReach, 0);
    Side side{.first = first, .begin = begin, .end = end, .weights = {}};
    for (int cell = first; cell < std::min(end + kReach, num_cells); ++cell) {
      double weight = 0.0;
      for (int middle = std::max(cell - 1, 0); middle <= std::min(cell + 1, num_cells - 1);
           ++middle) {
        const int in_patch = num_within(middle, 0, num_cells);
        weight += static_cast<double>(num_within(middle, begin, end)) / (in_patch * in_patch);
      }
      side.weights.push_back(weight);
    }
    sides.push_back(std::move(side));
  }
  return sides;
}

double ContourPull::of(std::int32_t label,
                       Block block,
                       std::span<const std::int32_t> labels) const {
  const Side& across = by_col_[static_cast<std::size_t>(block.col)];
  const Side& up = by_row_[static_cast<std::size_t>(block.row)];
  const auto before = static_cast<std::size_t>(across.begin - across.first);
  const auto behind = static_cast<std::size_t>(across.end - across.first);
  double sum = 0.0;
  for (std::size_t y = 0; y < up.weights.size(); ++y) {
    const int row = up.first + static_cast<int>(y);
    const std::int32_t* cells =
        &labels[static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                static_cast<std::size_t>(across.first)];
    const auto part = [&](std::size_t from, std::size_t to) {
      double weights = 0.0;
      for (std::size_t x = from; x < to; ++x) {
        weights += cells[x] == label ? across.weights[x] : 0.0;
      }
      return weights;
    };
    const bool has_block = row >= up.begin && row < up.end;
    const double weights = has_block ? part(0, before) + part(behind, across.weights.size())
                                     : part(0, across.weights.size());
    sum += up.weights[y] * weights;
  }
  return 2.0 * sum;
}

}  // namespace hypermap

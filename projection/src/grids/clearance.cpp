// SPDX-License-Identifier: BSD-3-Clause
#include "grids/clearance.hpp"

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

/// Of a row or column with one cell beyond the grid at either end, the lower envelope of
/// the parabolas over its cells: heights[q] + (p - q)^2 at each p.
class ParabolaEnvelope {
 public:
  explicit ParabolaEnvelope(std::size_t size) : lowest_(size), from_(size) {}

  void apply(std::vector<std::int64_t>& heights) {
    std::size_t last = 0;
    lowest_[0] = 0;
    from_[0] = 0;
    const auto size = static_cast<std::int64_t>(heights.size());
    for (std::int64_t q = 1; q < size; ++q) {
      while (last > 0 && first_below(heights, lowest_[last], q) <= from_[last]) --last;
      const std::int64_t begin = first_below(heights, lowest_[last], q);
      if (begin >= size) continue;
      ++last;
      lowest_[last] = q;
      from_[last] = begin;
    }
    const std::vector<std::int64_t> before = heights;
    std::size_t at = 0;
    for (std::int64_t p = 0; p < size; ++p) {
      while (at < last && from_[at + 1] <= p) ++at;
      const std::int64_t q = lowest_[at];
      heights[index(p)] = before[index(q)] + (p - q) * (p - q);
    }
  }

 private:
  static std::size_t index(std::int64_t p) { return static_cast<std::size_t>(p); }

  /// The first whole place, not before 0, where the parabola of `b` is lower than that of `a` <
  /// `b`.
  static std::int64_t first_below(const std::vector<std::int64_t>& heights,
                                  std::int64_t a,
                                  std::int64_t b) {
    const std::int64_t gain = heights[index(b)] + b * b - heights[index(a)] - a * a;
    const std::int64_t span = 2 * (b - a);
    return gain < 0 ? 0 : gain / span + 1;
  }

  std::vector<std::int64_t> lowest_;  ///< Whose parabola is lowest, piece by piece.
  std::vector<std::int64_t> from_;    ///< Where its piece begins.
};

}  // namespace

std::vector<std::int64_t> squared_clearance(const CellMask& mask, BeyondGrid beyond) {
  const auto cols = static_cast<std::size_t>(mask.cols);
  const auto rows = static_cast<std::size_t>(mask.rows);
  const auto far = static_cast<std::int64_t>(cols + rows + 2);
  const std::int64_t at_rim = beyond == BeyondGrid::kIn ? far * far : 0;
  std::vector<std::int64_t> clearance(cols * rows, 0);
  ParabolaEnvelope along_column(rows + 2);
  std::vector<std::int64_t> column(rows + 2, at_rim);
  for (std::size_t col = 0; col < cols; ++col) {
    for (std::size_t row = 0; row < rows; ++row) {
      column[row + 1] = mask.is_in[row * cols + col] != 0 ? far * far : 0;
    }
    along_column.apply(column);
    for (std::size_t row = 0; row < rows; ++row) clearance[row * cols + col] = column[row + 1];
    column.front() = column.back() = at_rim;
  }
  ParabolaEnvelope along_row(cols + 2);
  std::vector<std::int64_t> line(cols + 2, at_rim);
  for (std::size_t row = 0; row < rows; ++row) {
    line.front() = line.back() = at_rim;
    for (std::size_t col = 0; col < cols; ++col) line[col + 1] = clearance[row * cols + col];
    along_row.apply(line);
    for (std::size_t col = 0; col < cols; ++col) clearance[row * cols + col] = line[col + 1];
  }
  return clearance;
}

double gap_in_cells(std::int64_t squared) {
  return std::sqrt(static_cast<double>(squared)) - 0.5;
}

}  // namespace hypermap

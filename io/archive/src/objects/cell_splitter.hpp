// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Cells in the order in which the nodes of their octree are written.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {

/// A cell relative to the origin.
struct RelativeCell {
  std::array<std::uint32_t, 3> at{};
  std::uint32_t votes = 0;
};

/// Puts cells into the order of a level's nodes, level by level.
class CellSplitter {
 public:
  explicit CellSplitter(std::vector<RelativeCell> cells)
      : cells_(std::move(cells)), sorted_(cells_.size()), ends_{cells_.size()} {}

  [[nodiscard]] const std::vector<RelativeCell>& cells() const { return cells_; }

  /// Splits each node's cells by bit `height`; which children each has, in the order of nodes.
  std::vector<std::uint8_t> split(unsigned height) {
    std::vector<std::uint8_t> masks;
    masks.reserve(ends_.size());
    std::vector<std::size_t> next_ends;
    next_ends.reserve(cells_.size());
    std::size_t begin = 0;
    for (const std::size_t end : ends_) {
      masks.push_back(split_node(begin, end, height, next_ends));
      begin = end;
    }
    ends_ = std::move(next_ends);
    cells_.swap(sorted_);
    return masks;
  }

 private:
  static std::size_t child_of(const RelativeCell& cell, unsigned height) {
    return (cell.at[0] >> height & 1U) * 4U + (cell.at[1] >> height & 1U) * 2U +
           (cell.at[2] >> height & 1U);
  }

  std::uint8_t split_node(std::size_t begin,
                          std::size_t end,
                          unsigned height,
                          std::vector<std::size_t>& next_ends) {
    std::array<std::size_t, 8> counts{};
    for (std::size_t i = begin; i < end; ++i) ++counts[child_of(cells_[i], height)];
    std::array<std::size_t, 8> places{};
    std::uint32_t mask = 0;
    std::size_t place = begin;
    for (std::size_t k = 0; k < 8; ++k) {
      places.at(k) = place;
      place += counts.at(k);
      if (counts.at(k) == 0) continue;
      mask |= 1U << k;
      next_ends.push_back(place);
    }
    for (std::size_t i = begin; i < end; ++i)
      sorted_[places[child_of(cells_[i], height)]++] = cells_[i];
    return static_cast<std::uint8_t>(mask);
  }

  std::vector<RelativeCell> cells_;
  std::vector<RelativeCell> sorted_;
  std::vector<std::size_t> ends_;  // of each node's cells
};

}  // namespace hypermap

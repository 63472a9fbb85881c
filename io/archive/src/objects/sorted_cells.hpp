// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Cells in the order in which the nodes of their octree are written.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
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

/// Number 4 x + 2 y + z of a node's child, from bit `height` of a coordinate each.
inline std::uint32_t child_of(const RelativeCell& cell, unsigned height) {
  return (cell.at[0] >> height & 1U) * 4U + (cell.at[1] >> height & 1U) * 2U +
         (cell.at[2] >> height & 1U);
}

/// Different cells in Morton order, and which children the nodes over them have.
class SortedCells {
 public:
  /// Cost: linear, a pass for three levels each. Requires: coordinates below 2^levels.
  SortedCells(std::vector<RelativeCell> cells, int levels)
      : cells_(std::move(cells)), levels_(static_cast<unsigned>(levels)) {
    sort();
    find_children();
  }

  [[nodiscard]] const std::vector<RelativeCell>& cells() const { return cells_; }
  /// Bit k for child k of each node whose children's edge is 2^height cells, in Morton order.
  [[nodiscard]] const std::vector<std::uint8_t>& children(unsigned height) const {
    return children_[height];
  }

 private:
  static constexpr unsigned kLevelsAtOnce = 3;

  /// The next `kLevelsAtOnce` levels' numbers of children, the highest first.
  static std::uint32_t digit_of(const RelativeCell& cell, unsigned height) {
    static constexpr std::array<std::uint32_t, 8> kSpread{0, 1, 8, 9, 64, 65, 72, 73};
    return kSpread[cell.at[0] >> height & 7U] << 2U | kSpread[cell.at[1] >> height & 7U] << 1U |
           kSpread[cell.at[2] >> height & 7U];
  }

  void sort() {
    std::vector<RelativeCell> sorted(cells_.size());
    for (unsigned height = 0; height < levels_; height += kLevelsAtOnce) {
      std::array<std::uint32_t, 513> places{};
      for (const RelativeCell& cell : cells_) ++places[digit_of(cell, height) + 1];
      for (std::size_t i = 1; i < places.size(); ++i) places[i] += places[i - 1];
      for (const RelativeCell& cell : cells_) sorted[places[digit_of(cell, height)]++] = cell;
      cells_.swap(sorted);
    }
  }

  /// The height of the lowest node that is over a cell and the one before it; nothing is over the
  /// first and one before it.
  [[nodiscard]] unsigned common_height(std::size_t index) const {
    if (index == 0) return levels_ + 1;
    const RelativeCell& cell = cells_[index];
    const RelativeCell& before = cells_[index - 1];
    std::uint32_t different = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) different |= cell.at[axis] ^ before.at[axis];
    return static_cast<unsigned>(std::bit_width(different));
  }

  /// From the lowest nodes up.
  void find_children() {
    struct Node {
      std::uint32_t first_cell = 0;
      unsigned common_height = 0;
    };
    std::vector<Node> nodes;
    nodes.reserve(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i)
      nodes.push_back(
          {.first_cell = static_cast<std::uint32_t>(i), .common_height = common_height(i)});
    children_.resize(levels_);
    for (unsigned height = 0; height < levels_; ++height) {
      std::vector<std::uint8_t>& children = children_[height];
      children.reserve(nodes.size());
      std::size_t num_parents = 0;
      for (const Node& node : nodes) {
        if (node.common_height > height + 1) {
          children.push_back(0);
          nodes[num_parents++] = node;
        }
        const std::uint32_t child = child_of(cells_[node.first_cell], height);
        children.back() = static_cast<std::uint8_t>(children.back() | 1U << child);
      }
      nodes.resize(num_parents);
    }
  }

  std::vector<RelativeCell> cells_;
  unsigned levels_;
  std::vector<std::vector<std::uint8_t>> children_;  // by height
};

}  // namespace hypermap

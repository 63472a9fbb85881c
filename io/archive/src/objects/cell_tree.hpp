// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One level of an octree of cells, each node with those beside it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

struct CellNode {
  /// Index of no node.
  static constexpr std::uint32_t kNone = 0;

  std::array<std::uint32_t, 3> low{};  ///< Its lowest cell.
  std::uint32_t first_child = 0;       ///< Index in the next level.
  /// Index in this level of the next node down and up x, y and z; kNone where none is.
  std::array<std::uint32_t, 3> below{};
  std::array<std::uint32_t, 3> above{};
  std::uint8_t children = 0;  ///< Bit k for child k.
};

/// The nodes from index 1 on, in Morton order, so that what lies below a node in x, y or z stands
/// before it. Index 0 is no node: it has neither children nor neighbours, so that nobody needs to
/// ask before looking at a neighbour's neighbours.
using CellLevel = std::vector<CellNode>;

inline CellLevel root_level() {
  return CellLevel(2);
}

/// The bit of a child's number that says whether it is the upper one along an axis.
inline constexpr std::uint32_t axis_bit(std::size_t axis) {
  return 4U >> axis;
}

/// How many children bits stand for. (Without an instruction for it, which the oldest processors
/// lack, std::popcount is a call.)
inline std::uint32_t num_in(std::uint32_t children) {
  static constexpr std::array<std::uint8_t, 256> kCounts = [] {
    std::array<std::uint8_t, 256> counts{};
    for (std::size_t i = 0; i < counts.size(); ++i)
      counts.at(i) = static_cast<std::uint8_t>(std::popcount(i));
    return counts;
  }();
  return kCounts[children & 0xFFU];
}

/// Index in the next level of child `k`; kNone when there is none. Requires: first_child is set.
inline std::uint32_t child_index(const CellNode& node, std::uint32_t k) {
  const auto children = std::uint32_t{node.children};
  const std::uint32_t if_there = 0U - (children >> k & 1U);  // all bits or none
  return (node.first_child + num_in(children & ((1U << k) - 1U))) & if_there;
}

/// Says of a child where it is and what lies beside it. `k`: its number.
inline void place_child(CellNode& child,
                        const CellLevel& level,
                        const CellNode& node,
                        std::uint32_t k,
                        unsigned shift) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t bit = axis_bit(axis);
    const bool is_upper = (k & bit) != 0;
    child.low[axis] = node.low[axis] + (std::uint32_t{is_upper} << shift);
    const std::uint32_t sibling = child_index(node, k ^ bit);
    const CellNode& beside = level[is_upper ? node.above[axis] : node.below[axis]];
    const std::uint32_t other = child_index(beside, k ^ bit);
    child.below[axis] = is_upper ? sibling : other;
    child.above[axis] = is_upper ? other : sibling;
  }
}

/// The children of all nodes. `shift`: the edge of a child is 2^shift cells.
inline CellLevel next_level(CellLevel& level, unsigned shift) {
  std::uint32_t num_nodes = 1;
  for (CellNode& node : level) {
    node.first_child = num_nodes;
    num_nodes += num_in(node.children);
  }
  CellLevel next(num_nodes);
  auto child = next.begin() + 1;
  for (const CellNode& node : level) {
    for (std::uint32_t rest = node.children; rest != 0; rest &= rest - 1, ++child)
      place_child(*child, level, node, static_cast<std::uint32_t>(std::countr_zero(rest)), shift);
  }
  return next;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Nodes and votes of an octree of cells as bits, each of a kind that says how probable it is.
#pragma once

#include "adaptive_bits.hpp"
#include "cell_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {

inline constexpr std::size_t kNumAverages = 16;
inline constexpr std::size_t kNumVoteKinds = kNumAverages * 3;
inline constexpr std::size_t kVoteBits = 32;

/// What is known of a node's children before they are coded, a byte for each, the lowest for child
/// 0: from the highest bit on whether there is a cell of their level down x, down y and down z,
/// whether there may be any up x, y and z, how many lie down two of these (of those that a node
/// between leads to).
using ChildKinds = std::uint64_t;

constexpr std::uint64_t in_lane(std::uint32_t k, std::uint32_t value) {
  return std::uint64_t{value} << 8U * k;
}
constexpr std::uint32_t face_value(std::size_t axis) {
  return axis_bit(axis) << 5U;
}
constexpr std::uint32_t above_value(std::size_t axis) {
  return axis_bit(axis) << 2U;
}
constexpr std::uint32_t kEdgeValue = 1;

/// What child `k` of a node means to the others, if it is there.
constexpr ChildKinds known_from_sibling(std::uint32_t k) {
  ChildKinds kinds = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t bit = axis_bit(axis);
    if ((k & bit) == 0) kinds += in_lane(k | bit, face_value(axis));
    const std::uint32_t two = 7U ^ bit;
    if ((k & two) == 0) kinds += in_lane(k | two, kEdgeValue);
  }
  return kinds;
}

/// What the children of the node down one axis mean to those of a node, by their bits. A lower
/// child has the upper one there beside its face, and across its edges those that are upper ones
/// along the axis and lower ones along another.
constexpr ChildKinds known_from_face(std::size_t axis, std::uint32_t children) {
  ChildKinds kinds = 0;
  const std::uint32_t bit = axis_bit(axis);
  for (std::uint32_t k = 0; k < 8; ++k) {
    if ((children >> k & 1U) == 0 || (k & bit) == 0) continue;
    kinds += in_lane(k ^ bit, face_value(axis));
    for (std::size_t other = 0; other < 3; ++other) {
      if (other != axis && (k & axis_bit(other)) == 0)
        kinds += in_lane(k ^ bit ^ axis_bit(other), kEdgeValue);
    }
  }
  return kinds;
}

/// The same of the node down both other axes than `axis`.
constexpr ChildKinds known_from_edge(std::size_t axis, std::uint32_t children) {
  ChildKinds kinds = 0;
  const std::uint32_t two = 7U ^ axis_bit(axis);
  for (std::uint32_t k = 0; k < 8; ++k)
    if ((children >> k & 1U) != 0 && (k & two) == two) kinds += in_lane(k ^ two, kEdgeValue);
  return kinds;
}

/// `above`: the axes up which there is a node. A lower child may always have one beside it.
constexpr ChildKinds known_from_above(std::uint32_t above) {
  ChildKinds kinds = 0;
  for (std::uint32_t k = 0; k < 8; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t bit = axis_bit(axis);
      if ((k & bit) == 0 || (above & bit) != 0) kinds += in_lane(k, above_value(axis));
    }
  }
  return kinds;
}

/// The four functions for all that they are asked.
struct ChildKindTables {
  std::array<ChildKinds, 8> sibling{};
  std::array<ChildKinds, 8> above{};
  std::array<std::array<ChildKinds, 256>, 3> face{};
  std::array<std::array<ChildKinds, 256>, 3> edge{};
};
inline constexpr ChildKindTables kChildKinds = [] {
  ChildKindTables tables;
  for (std::uint32_t k = 0; k < 8; ++k) {
    tables.sibling.at(k) = known_from_sibling(k);
    tables.above.at(k) = known_from_above(k);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::uint32_t children = 0; children < 256; ++children) {
      tables.face.at(axis).at(children) = known_from_face(axis, children);
      tables.edge.at(axis).at(children) = known_from_edge(axis, children);
    }
  }
  return tables;
}();

/// The children of the node down `one` and `two`, which lies down `two` of that down `one` and the
/// other way round; either may be missing.
inline std::uint32_t edge_children(const CellLevel& level,
                                   const CellNode& node,
                                   std::size_t one,
                                   std::size_t two) {
  const CellNode& by_one = level[level[node.below[one]].below[two]];
  const CellNode& by_two = level[level[node.below[two]].below[one]];
  return std::uint32_t{by_one.children} | std::uint32_t{by_two.children};
}

/// All that the nodes beside a node, coded before it, say of its children.
inline ChildKinds kinds_of_children(const CellLevel& level, const CellNode& node) {
  ChildKinds kinds = 0;
  std::uint32_t above = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (node.above[axis] != CellNode::kNone) above |= axis_bit(axis);
    kinds += kChildKinds.face[axis][level[node.below[axis]].children];
    kinds += kChildKinds.edge[axis][edge_children(level, node, (axis + 1) % 3, (axis + 2) % 3)];
  }
  return kinds + kChildKinds.above[above];
}

/// Half logarithms of a mean, 1 for 1; 0 for no mean.
inline std::size_t average_kind(std::uint64_t sum, std::uint64_t count) {
  if (count == 0) return 0;
  const std::uint64_t quarters = 4 * sum / count;
  const auto width = static_cast<std::size_t>(std::bit_width(quarters));
  const std::size_t half = quarters >> (width - 2) & 1U;
  return std::min(kNumAverages - 1, 2 * (width - 3) + half + 1);
}

/// `votes_before`: by the index of a cell; of no cell 0.
inline std::size_t vote_kind(const CellNode& cell, const std::vector<std::uint32_t>& votes_before) {
  std::uint64_t sum = 0;
  std::size_t num_below = 0;
  std::size_t num_above = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    num_above += cell.above[axis] != CellNode::kNone ? 1U : 0U;
    num_below += cell.below[axis] != CellNode::kNone ? 1U : 0U;
    sum += votes_before[cell.below[axis]];
  }
  const std::size_t num_beside = num_below + num_above;
  return average_kind(sum, num_below) * 3 + std::min<std::size_t>(num_beside / 2, 2);
}

/// Nodes and votes by an encoder or a decoder, which tells of what it is given or what it finds.
template <class Bits>
class CellCoder {
 public:
  explicit CellCoder(Bits bits) : bits_(std::move(bits)) {}
  [[nodiscard]] Bits& bits() { return bits_; }

  /// `height`: the edge of a child is 2^height cells.
  std::uint32_t code_children(const CellLevel& level,
                              const CellNode& node,
                              int height,
                              std::uint32_t children) {
    auto& models = children_.at(static_cast<std::size_t>(std::min(height, 2)));
    ChildKinds kinds = kinds_of_children(level, node);
    auto bits = bits_.cursor();
    std::uint32_t coded = 0;
    const auto code_child = [&](std::uint32_t k) {
      const bool is_there = bits.code(models[kinds >> 8U * k & 0xFFU], (children >> k & 1U) != 0);
      kinds += kChildKinds.sibling[k] & (std::uint64_t{0} - std::uint64_t{is_there});
      coded |= std::uint32_t{is_there} << k;
    };
    code_child(0);
    code_child(1);
    code_child(2);
    code_child(3);
    code_child(4);
    code_child(5);
    code_child(6);
    if (coded == 0) {
      coded = 1U << 7U;  // a node has a child
    } else {
      code_child(7);
    }
    bits_.keep(bits);
    return coded;
  }

  /// The number of digits in the base of two, then those after the first one.
  std::uint32_t code_votes(const CellNode& cell,
                           const std::vector<std::uint32_t>& votes_before,
                           std::uint32_t votes) {
    const std::size_t kind = vote_kind(cell, votes_before);
    const auto width = static_cast<std::size_t>(std::bit_width(votes));
    auto bits = bits_.cursor();
    std::size_t num_digits = 1;
    while (num_digits < kVoteBits && bits.code(more_digits_[kind][num_digits], width > num_digits))
      ++num_digits;
    std::uint32_t coded = 1;
    for (std::size_t place = num_digits - 1; place-- > 0;) {
      const bool digit = (votes >> place & 1U) != 0;
      coded = 2 * coded + (code_digit(bits, kind, num_digits, coded, digit) ? 1U : 0U);
    }
    bits_.keep(bits);
    return coded;
  }

 private:
  using Cursor = typename Bits::Cursor;

  bool code_digit(
      Cursor& bits, std::size_t kind, std::size_t num_digits, std::uint32_t before, bool digit) {
    if (before == 1) return bits.code(second_digit_[kind][num_digits - 1], digit);
    if (before < 4) return bits.code(third_digit_[num_digits - 1][before - 2], digit);
    return bits.code_even(digit);
  }

  Bits bits_;
  std::array<std::array<BitModel, 256>, 3> children_;
  std::array<std::array<BitModel, kVoteBits>, kNumVoteKinds> more_digits_;
  std::array<std::array<BitModel, kVoteBits>, kNumVoteKinds> second_digit_;
  std::array<std::array<BitModel, 2>, kVoteBits> third_digit_;
};

}  // namespace hypermap

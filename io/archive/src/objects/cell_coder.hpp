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

/// The children of a node, none for no node.
inline std::uint64_t children_of(const CellLevel& level, std::uint32_t node) {
  return node == CellNode::kNone ? 0U : level[node].children;
}

/// Those of the node down `axis` of the one down `other`.
inline std::uint64_t edge_children(const CellLevel& level,
                                   const CellNode& node,
                                   std::size_t axis,
                                   std::size_t other) {
  if (node.below[other] != CellNode::kNone)
    return children_of(level, level[node.below[other]].below[axis]);
  if (node.below[axis] == CellNode::kNone) return 0;
  return children_of(level, level[node.below[axis]].below[other]);
}

/// Eight bits each: a node's own children, those of the nodes down x, y, z, and of those down y and
/// z, x and z, x and y. Its own are not coded yet.
inline std::uint64_t surroundings_of(const CellLevel& level, const CellNode& node) {
  std::uint64_t around = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    around |= children_of(level, node.below[axis]) << (8U + 8U * axis);
    around |= edge_children(level, node, (axis + 1) % 3, (axis + 2) % 3) << (32U + 8U * axis);
  }
  return around;
}

/// Where the cells beside a child stand in its node's surroundings, and up which axes there may be
/// some whatever stands beside the node.
struct ChildPlace {
  std::array<std::uint8_t, 3> faces{};  ///< Those down x, y, z.
  std::array<std::uint8_t, 3> edges{};  ///< Those down y and z, x and z, x and y.
  std::uint32_t above = 0;
};

constexpr ChildPlace place_of_child(std::uint32_t k) {
  ChildPlace place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::uint32_t bit = axis_bit(axis);
    const std::size_t face_node = (k & bit) != 0 ? 0 : 1 + axis;
    place.faces.at(axis) = static_cast<std::uint8_t>(8 * face_node + (k ^ bit));
    if ((k & bit) == 0) place.above |= bit;
    const std::size_t one = (axis + 1) % 3;
    const std::size_t two = (axis + 2) % 3;
    const bool leaves_one = (k & axis_bit(one)) == 0;
    const bool leaves_two = (k & axis_bit(two)) == 0;
    std::size_t edge_node = 0;
    if (leaves_one) edge_node = 1 + one;
    if (leaves_two) edge_node = 1 + two;
    if (leaves_one && leaves_two) edge_node = 4 + axis;
    place.edges.at(axis) =
        static_cast<std::uint8_t>(8 * edge_node + (k ^ axis_bit(one) ^ axis_bit(two)));
  }
  return place;
}
inline constexpr std::array<ChildPlace, 8> kChildPlaces{place_of_child(0),
                                                        place_of_child(1),
                                                        place_of_child(2),
                                                        place_of_child(3),
                                                        place_of_child(4),
                                                        place_of_child(5),
                                                        place_of_child(6),
                                                        place_of_child(7)};

/// What is known of a child before it is coded: the cells of its level down x, y and z, whether
/// there may be any up x, y and z, how many lie down two of these.
inline std::size_t child_kind(std::uint64_t around, std::uint32_t above, const ChildPlace& place) {
  const auto is_there = [around](std::uint8_t at) { return around >> at & 1U; };
  const std::uint64_t faces =
      4U * is_there(place.faces[0]) + 2U * is_there(place.faces[1]) + is_there(place.faces[2]);
  const std::uint64_t num_edges =
      is_there(place.edges[0]) + is_there(place.edges[1]) + is_there(place.edges[2]);
  return (8U * faces + (above | place.above)) * 4U + num_edges;
}

/// Half logarithms of a mean, 1 for 1; 0 for no mean.
inline std::size_t average_kind(std::uint64_t sum, std::uint64_t count) {
  if (count == 0) return 0;
  const std::uint64_t quarters = 4 * sum / count;
  const auto width = static_cast<std::size_t>(std::bit_width(quarters));
  const std::size_t half = quarters >> (width - 2) & 1U;
  return std::min(kNumAverages - 1, 2 * (width - 3) + half + 1);
}

inline std::size_t vote_kind(const CellNode& cell, const std::vector<std::uint32_t>& votes_before) {
  std::uint64_t sum = 0;
  std::size_t num_below = 0;
  std::size_t num_beside = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (cell.above[axis] != CellNode::kNone) ++num_beside;
    if (cell.below[axis] == CellNode::kNone) continue;
    ++num_beside;
    ++num_below;
    sum += votes_before[cell.below[axis]];
  }
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
    std::uint64_t around = surroundings_of(level, node);
    std::uint32_t above = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (node.above[axis] != CellNode::kNone) above |= axis_bit(axis);
    const auto code_child = [&](std::uint32_t k) {
      BitModel& model = models[child_kind(around, above, kChildPlaces[k])];
      const bool is_there = bits_.code(model, (children >> k & 1U) != 0);
      around |= std::uint64_t{is_there} << k;
    };
    for (std::uint32_t k = 0; k < 7; ++k) code_child(k);
    if ((around & 0x7FU) == 0) return 1U << 7U;  // a node has a child
    code_child(7);
    return static_cast<std::uint32_t>(around & 0xFFU);
  }

  /// The number of digits in the base of two, then those after the first one.
  std::uint32_t code_votes(const CellNode& cell,
                           const std::vector<std::uint32_t>& votes_before,
                           std::uint32_t votes) {
    const std::size_t kind = vote_kind(cell, votes_before);
    const auto width = static_cast<std::size_t>(std::bit_width(votes));
    std::size_t num_digits = 1;
    while (num_digits < kVoteBits && bits_.code(more_digits_[kind][num_digits], width > num_digits))
      ++num_digits;
    std::uint32_t coded = 1;
    for (std::size_t place = num_digits - 1; place-- > 0;) {
      const bool digit = (votes >> place & 1U) != 0;
      coded = 2 * coded + (code_digit(kind, num_digits, coded, digit) ? 1U : 0U);
    }
    return coded;
  }

 private:
  bool code_digit(std::size_t kind, std::size_t num_digits, std::uint32_t before, bool digit) {
    if (before == 1) return bits_.code(second_digit_[kind][num_digits - 1], digit);
    if (before < 4) return bits_.code(third_digit_[num_digits - 1][before - 2], digit);
    return bits_.code_even(digit);
  }

  Bits bits_;
  std::array<std::array<BitModel, 256>, 3> children_;
  std::array<std::array<BitModel, kVoteBits>, kNumVoteKinds> more_digits_;
  std::array<std::array<BitModel, kVoteBits>, kNumVoteKinds> second_digit_;
  std::array<std::array<BitModel, 2>, kVoteBits> third_digit_;
};

}  // namespace hypermap

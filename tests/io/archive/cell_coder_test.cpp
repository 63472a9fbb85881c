// SPDX-License-Identifier: BSD-3-Clause
#include "objects/cell_coder.hpp"

#include "objects/sorted_cells.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace hypermap {
namespace {

using LevelPlace = std::array<std::int64_t, 3>;

/// Where a child of its level is, in edges of that level.
LevelPlace place_of(const CellNode& node, std::uint32_t k, unsigned height) {
  LevelPlace place{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    place.at(axis) = (node.low.at(axis) >> height) + ((k & axis_bit(axis)) != 0 ? 1 : 0);
  return place;
}

LevelPlace node_of(const LevelPlace& child) {
  return {child[0] >> 1, child[1] >> 1, child[2] >> 1};
}

/// What stands in the docstring of ChildKinds, found by looking for each place.
std::uint32_t kind_by_search(const std::set<LevelPlace>& coded,
                             const std::set<LevelPlace>& nodes,
                             const LevelPlace& place) {
  std::uint32_t kind = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    LevelPlace down = place;
    --down.at(axis);
    if (coded.contains(down)) kind += 128U >> axis;
    LevelPlace up = place;
    ++up.at(axis);
    if (nodes.contains(node_of(up))) kind += 16U >> axis;
    LevelPlace by_one = place;
    --by_one.at((axis + 1) % 3);
    LevelPlace by_two = place;
    --by_two.at((axis + 2) % 3);
    LevelPlace edge = by_one;
    --edge.at((axis + 2) % 3);
    if (coded.contains(edge) &&
        (nodes.contains(node_of(by_one)) || nodes.contains(node_of(by_two))))
      ++kind;
  }
  return kind;
}

std::uint32_t lane(ChildKinds kinds, std::uint32_t k) {
  return static_cast<std::uint32_t>(kinds >> 8U * k & 0xFFU);
}

TEST(ChildKinds, OfTheHand) {
  // A root alone: its lower children may have others up each axis, child 7 up none.
  const CellLevel root = root_level();
  const ChildKinds kinds = kinds_of_children(root, root[1]);
  EXPECT_EQ(lane(kinds, 0), 7U << 2U);
  EXPECT_EQ(lane(kinds, 7), 0U);
  // Child 0 lies down x of child 4 and across an edge from child 6.
  EXPECT_EQ(lane(kinds + kChildKinds.sibling[0], 4), (4U << 5U) + (3U << 2U));
  EXPECT_EQ(lane(kinds + kChildKinds.sibling[0], 6), (1U << 2U) + 1U);
}

TEST(ChildKinds, AreWhatASearchOfTheLevelFinds) {
  constexpr int kLevels = 4;
  std::mt19937 engine(13);
  std::set<std::array<std::uint32_t, 3>> places;
  while (places.size() < 700)
    places.insert({static_cast<std::uint32_t>(engine() % 16),
                   static_cast<std::uint32_t>(engine() % 16),
                   static_cast<std::uint32_t>(engine() % 16)});
  std::vector<RelativeCell> cells;
  cells.reserve(places.size());
  for (const auto& at : places) cells.push_back({.at = at, .votes = 1});
  const SortedCells sorted(std::move(cells), kLevels);
  CellLevel level = root_level();
  std::size_t num_compared = 0;
  for (int height = kLevels; height-- > 0;) {
    const auto shift = static_cast<unsigned>(height);
    std::set<LevelPlace> nodes;
    for (std::size_t i = 1; i < level.size(); ++i) nodes.insert(place_of(level[i], 0, shift + 1));
    std::set<LevelPlace> coded;
    for (std::size_t i = 1; i < level.size(); ++i) {
      level[i].children = sorted.children(shift)[i - 1];
      ChildKinds kinds = kinds_of_children(level, level[i]);
      for (std::uint32_t k = 0; k < 8; ++k) {
        const LevelPlace place = place_of(level[i], k, shift);
        ASSERT_EQ(lane(kinds, k), kind_by_search(coded, nodes, place));
        ++num_compared;
        if ((level[i].children >> k & 1U) == 0) continue;
        kinds += kChildKinds.sibling[k];
        coded.insert(place);
      }
    }
    level = next_level(level, shift);
  }
  EXPECT_EQ(level.size() - 1, places.size());
  EXPECT_GT(num_compared, 3000U);
}

TEST(CellLevels, NeighboursAreThoseBesideEachCell) {
  constexpr int kLevels = 3;
  std::mt19937 engine(17);
  std::set<std::array<std::uint32_t, 3>> places;
  while (places.size() < 200)
    places.insert({static_cast<std::uint32_t>(engine() % 8),
                   static_cast<std::uint32_t>(engine() % 8),
                   static_cast<std::uint32_t>(engine() % 8)});
  std::vector<RelativeCell> cells;
  cells.reserve(places.size());
  for (const auto& at : places) cells.push_back({.at = at, .votes = 1});
  const SortedCells sorted(std::move(cells), kLevels);
  CellLevel level = root_level();
  for (int height = kLevels; height-- > 0;) {
    const auto shift = static_cast<unsigned>(height);
    for (std::size_t i = 1; i < level.size(); ++i)
      level[i].children = sorted.children(shift)[i - 1];
    level = next_level(level, shift);
  }
  ASSERT_EQ(level.size() - 1, places.size());
  for (std::size_t i = 1; i < level.size(); ++i) {
    EXPECT_EQ(level[i].low, sorted.cells()[i - 1].at);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const bool is_up : {false, true}) {
        std::array<std::uint32_t, 3> beside = level[i].low;
        beside.at(axis) += is_up ? 1U : ~0U;  // down from 0 is nowhere
        const std::uint32_t index = is_up ? level[i].above.at(axis) : level[i].below.at(axis);
        ASSERT_EQ(index != CellNode::kNone, places.contains(beside));
        if (index == CellNode::kNone) continue;
        EXPECT_EQ(level[index].low, beside);
      }
    }
  }
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "objects/sorted_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace hypermap {
namespace {

using ChildPath = std::vector<std::uint32_t>;

/// The numbers of the children on the way from the root down to height `height`.
ChildPath path_to(const RelativeCell& cell, int levels, int height) {
  ChildPath path;
  for (int h = levels; h-- > height;) path.push_back(child_of(cell, static_cast<unsigned>(h)));
  return path;
}

std::vector<RelativeCell> scattered_cells(int levels, std::size_t count) {
  std::mt19937 engine(7);
  const std::uint32_t most = levels == 32 ? ~0U : (1U << static_cast<unsigned>(levels)) - 1U;
  std::set<std::array<std::uint32_t, 3>> places{{0, 0, 0}, {most, most, most}};
  while (places.size() < count)
    places.insert({static_cast<std::uint32_t>(engine()) & most,
                   static_cast<std::uint32_t>(engine()) & most,
                   static_cast<std::uint32_t>(engine()) & most});
  std::vector<RelativeCell> cells;
  cells.reserve(places.size());
  for (const auto& at : places)
    cells.push_back({.at = at, .votes = static_cast<std::uint32_t>(cells.size()) + 1});
  std::shuffle(cells.begin(), cells.end(), engine);
  return cells;
}

TEST(SortedCells, TwoCellsOfTheHand) {
  // (3, 0, 1) is child 4 at height 1, then 5; (0, 0, 1) is child 0, then 1, and stands before it.
  const SortedCells sorted({{.at = {3, 0, 1}, .votes = 8}, {.at = {0, 0, 1}, .votes = 9}}, 2);
  EXPECT_EQ(sorted.cells()[0].votes, 9U);
  EXPECT_EQ(sorted.cells()[1].votes, 8U);
  EXPECT_EQ(sorted.children(1), (std::vector<std::uint8_t>{0b0001'0001}));
  EXPECT_EQ(sorted.children(0), (std::vector<std::uint8_t>{0b0000'0010, 0b0010'0000}));
}

TEST(SortedCells, OneCellOfNoLevels) {
  const SortedCells sorted({{.at = {}, .votes = 3}}, 0);
  ASSERT_EQ(sorted.cells().size(), 1U);
  EXPECT_EQ(sorted.cells()[0].votes, 3U);
}

TEST(SortedCells, OrderAndChildrenAreThoseOfPathsFromTheRoot) {
  for (const int levels : {1, 2, 3, 4, 7, 32}) {
    const std::vector<RelativeCell> cells = scattered_cells(levels, levels == 1 ? 6 : 60);
    const SortedCells sorted(cells, levels);
    std::map<ChildPath, std::uint32_t> votes;
    for (const RelativeCell& cell : cells) votes[path_to(cell, levels, 0)] = cell.votes;
    ASSERT_EQ(sorted.cells().size(), votes.size());
    auto expected_cell = votes.begin();
    for (const RelativeCell& cell : sorted.cells()) EXPECT_EQ(cell.votes, expected_cell++->second);
    for (int height = 0; height < levels; ++height) {
      std::map<ChildPath, std::uint32_t> children;
      for (const RelativeCell& cell : cells)
        children[path_to(cell, levels, height + 1)] |=
            1U << child_of(cell, static_cast<unsigned>(height));
      std::vector<std::uint8_t> expected;
      expected.reserve(children.size());
      for (const auto& [path, bits] : children) expected.push_back(static_cast<std::uint8_t>(bits));
      EXPECT_EQ(sorted.children(static_cast<unsigned>(height)), expected)
          << levels << " levels, height " << height;
    }
  }
}

}  // namespace
}  // namespace hypermap

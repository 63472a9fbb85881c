// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/common_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs common_cells(const std::vector<PointVote>& finer,
                   const std::vector<PointVote>& coarser,
                   int shift) {
  Pairs found;
  for_each_common_cell(
      finer, coarser, shift, [&](std::size_t i, std::size_t k) { found.emplace_back(i, k); });
  return found;
}

/// Every cell of one list against every cell of the other.
Pairs compared_one_by_one(const std::vector<PointVote>& finer,
                          const std::vector<PointVote>& coarser,
                          int shift) {
  Pairs found;
  for (std::size_t i = 0; i < finer.size(); ++i) {
    const PointCell& cell = finer[i].cell;
    const PointCell around{cell.x >> shift, cell.y >> shift, cell.z >> shift};
    for (std::size_t k = 0; k < coarser.size(); ++k) {
      if (coarser[k].cell == around) found.emplace_back(i, k);
    }
  }
  return found;
}

/// Cells with coordinates from `low` up to `low + size`, ascending, each once.
std::vector<PointVote> random_cells(std::mt19937& random, int count, int low, int size) {
  std::uniform_int_distribution<std::int32_t> at(low, low + size);
  std::vector<PointVote> votes;
  votes.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) votes.push_back({{at(random), at(random), at(random)}, 1});
  std::sort(votes.begin(), votes.end());
  votes.erase(std::unique(votes.begin(), votes.end()), votes.end());
  return votes;
}

TEST(CommonCells, AreThoseOfAComparisonOneByOneInItsOrder) {
  std::mt19937 random(11);
  std::size_t num_common = 0;
  for (int round = 0; round < 200; ++round) {
    const int shift = round % 4;
    const int size = 2 + round % 17;
    const auto finer = random_cells(random, 300, -size, 2 * size);
    const auto coarser =
        random_cells(random, 300, (round % 5 - size) >> shift, (2 * size) >> shift);
    const Pairs expected = compared_one_by_one(finer, coarser, shift);
    num_common += expected.size();
    ASSERT_EQ(common_cells(finer, coarser, shift), expected) << round;
  }
  EXPECT_GT(num_common, 10'000U);
}

TEST(CommonCells, AListHasAllOfItselfAndNothingOfAnEmptyOne) {
  std::mt19937 random(12);
  const auto cells = random_cells(random, 200, -8, 16);
  const Pairs found = common_cells(cells, cells, 0);
  ASSERT_EQ(found.size(), cells.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], std::pair(i, i));
  EXPECT_TRUE(common_cells(cells, {}, 0).empty());
  EXPECT_TRUE(common_cells({}, cells, 1).empty());
}

TEST(CommonCells, CoordinatesMayBeTheLastOnes) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();
  const std::vector<PointVote> ends{{{kLow, kLow, kLow}, 1}, {{kHigh, kHigh, kHigh}, 1}};
  EXPECT_EQ(common_cells(ends, ends, 0), (Pairs{{0, 0}, {1, 1}}));
  EXPECT_TRUE(common_cells(ends, ends, 1).empty()) << "their wider cells are others";
}

}  // namespace
}  // namespace hypermap

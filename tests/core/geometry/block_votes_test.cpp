// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/block_votes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <vector>

namespace hypermap {
namespace {

/// Half of all cells lie in blocks with as many or more.
std::uint32_t usual_count(const std::map<PointCell, std::uint32_t>& counts) {
  std::vector<std::uint32_t> of_each_cell;
  for (const auto& [block, count] : counts) of_each_cell.insert(of_each_cell.end(), count, count);
  std::ranges::sort(of_each_cell);
  return of_each_cell[of_each_cell.size() / 2];
}

TEST(BlockVotes, ACellHasTheSumOfItsFourByFourByFour) {
  // 0 and 3 share a block, 4 is in the next; -1 is in the one before, on each axis.
  const std::vector<PointVote> votes{
      {{-1, 0, 0}, 7}, {{0, 0, 0}, 1}, {{3, 3, 3}, 2}, {{4, 0, 0}, 5}};
  const CellBlocks blocks(votes);
  ASSERT_EQ(blocks.size(), 3U);
  EXPECT_EQ(std::vector(blocks.of_cells().begin(), blocks.of_cells().end()),
            (std::vector<std::uint32_t>{0, 1, 1, 2}));
  EXPECT_EQ(blocks.find({-1, 0, 0}), 0U);
  EXPECT_EQ(blocks.find({1, 0, 0}), 2U);
  EXPECT_FALSE(blocks.find({2, 0, 0}).has_value());
  const BlockVotes in_blocks = block_votes(votes, blocks);
  // A block usually has one cell: the one with two has half of its 3 votes, rounded up.
  EXPECT_EQ(in_blocks.sums, (std::vector<std::uint32_t>{7, 2, 5}));
  EXPECT_EQ(in_blocks.best, (std::vector<std::uint32_t>{7, 2, 5}));
  // Of 14 votes, 7 and then 5 lie in blocks with more: the middle one is in the block of 5.
  EXPECT_EQ(in_blocks.typical, 5U);
}

TEST(BlockVotes, NoVotesHaveNoBlocks) {
  const BlockVotes blocks = block_votes({}, CellBlocks({}));
  EXPECT_TRUE(blocks.sums.empty());
  EXPECT_EQ(blocks.typical, 1U);
}

TEST(BlockVotes, OfManyCellsAsManyCountAsUsual) {
  // Five blocks of a surface have 4 cells of 10 votes, one along an edge 16 of 2 votes: 16 of 36
  // cells lie there and the middle one in a block of 4, so that 4 of its 16 cells count: 8 of 32
  // votes.
  std::vector<PointVote> votes;
  for (std::int32_t i = 0; i < 24; ++i) {
    const bool is_on_face = i < 20;
    for (std::int32_t k = 0; k < (is_on_face ? 1 : 4); ++k) {
      votes.push_back({{i, k, 0}, is_on_face ? 10U : 2U});
    }
  }
  const BlockVotes in_blocks = block_votes(votes, CellBlocks(votes));
  EXPECT_EQ(in_blocks.sums, (std::vector<std::uint32_t>{40, 40, 40, 40, 40, 8}));
  EXPECT_EQ(in_blocks.typical, 40U);
}

TEST(BlockVotes, AreThoseOfACountByMap) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uint32_t> votes_of(1, 9);
  for (int round = 0; round < 20; ++round) {
    std::map<PointCell, std::uint32_t> cells;
    const std::int32_t reach = round % 2 == 0 ? 12 : 1'000'000'000;
    std::uniform_int_distribution<std::int32_t> within(-reach, reach);
    for (int i = 0; i < 500; ++i) {
      cells[{within(random), within(random), within(random)}] += votes_of(random);
    }
    std::vector<PointVote> votes;
    std::map<PointCell, std::uint32_t> sums;
    std::map<PointCell, std::uint32_t> counts;
    for (const auto& [cell, count] : cells) {
      votes.push_back({cell, count});
      sums[{cell.x >> 2, cell.y >> 2, cell.z >> 2}] += count;
      ++counts[{cell.x >> 2, cell.y >> 2, cell.z >> 2}];
    }
    const double usual = usual_count(counts);
    const CellBlocks blocks(votes);
    const BlockVotes in_blocks = block_votes(votes, blocks);
    EXPECT_EQ(blocks.size(), sums.size());
    for (std::size_t i = 0; i < votes.size(); ++i) {
      const PointCell cell = votes[i].cell;
      const PointCell block{cell.x >> 2, cell.y >> 2, cell.z >> 2};
      const double share = std::min(1.0, usual / counts.at(block));
      EXPECT_NEAR(in_blocks.sums[blocks.of_cells()[i]], share * sums.at(block), 0.5);
    }
  }
}

TEST(BlockVotes, SumsEndAtTheLargestNumber) {
  constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
  const std::vector<PointVote> votes{{{0, 0, 0}, kLargest}, {{0, 0, 1}, 2}};
  EXPECT_EQ(block_votes(votes, CellBlocks(votes)).sums, std::vector<std::uint32_t>{kLargest});
}

}  // namespace
}  // namespace hypermap

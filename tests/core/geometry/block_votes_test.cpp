// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/block_votes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <vector>

namespace hypermap {
namespace {

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
  EXPECT_EQ(in_blocks.sums, (std::vector<std::uint32_t>{7, 3, 5}));
  EXPECT_EQ(in_blocks.best, (std::vector<std::uint32_t>{7, 2, 5}));
  // Of 15 votes, 7 and then 5 lie in blocks with more: the middle one is in the block of 5.
  EXPECT_EQ(in_blocks.typical, 5U);
}

TEST(BlockVotes, NoVotesHaveNoBlocks) {
  const BlockVotes blocks = block_votes({}, CellBlocks({}));
  EXPECT_TRUE(blocks.sums.empty());
  EXPECT_EQ(blocks.typical, 1U);
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
    for (const auto& [cell, count] : cells) {
      votes.push_back({cell, count});
      sums[{cell.x >> 2, cell.y >> 2, cell.z >> 2}] += count;
    }
    const CellBlocks blocks(votes);
    const BlockVotes in_blocks = block_votes(votes, blocks);
    EXPECT_EQ(blocks.size(), sums.size());
    for (std::size_t i = 0; i < votes.size(); ++i) {
      const PointCell& cell = votes[i].cell;
      EXPECT_EQ(in_blocks.sums[blocks.of_cells()[i]],
                sums.at({cell.x >> 2, cell.y >> 2, cell.z >> 2}));
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

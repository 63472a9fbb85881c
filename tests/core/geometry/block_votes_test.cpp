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
  const BlockVotes blocks = block_votes(votes);
  EXPECT_EQ(blocks.of_cell, (std::vector<std::uint32_t>{7, 3, 3, 5}));
  EXPECT_EQ(blocks.best_of_cell, (std::vector<std::uint32_t>{7, 2, 2, 5}));
  // Of 15 votes, 7 and then 5 lie in blocks with more: the middle one is in the block of 5.
  EXPECT_EQ(blocks.typical, 5U);
}

TEST(BlockVotes, NoVotesHaveNoBlocks) {
  const BlockVotes blocks = block_votes({});
  EXPECT_TRUE(blocks.of_cell.empty());
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
    const BlockVotes blocks = block_votes(votes);
    for (std::size_t i = 0; i < votes.size(); ++i) {
      const PointCell& cell = votes[i].cell;
      EXPECT_EQ(blocks.of_cell[i], sums.at({cell.x >> 2, cell.y >> 2, cell.z >> 2}));
    }
  }
}

TEST(BlockVotes, SumsEndAtTheLargestNumber) {
  constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max();
  const std::vector<PointVote> votes{{{0, 0, 0}, kLargest}, {{0, 0, 1}, 2}};
  EXPECT_EQ(block_votes(votes).of_cell, (std::vector<std::uint32_t>{kLargest, kLargest}));
}

}  // namespace
}  // namespace hypermap

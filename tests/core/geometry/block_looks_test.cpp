// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/block_looks.hpp"

#include "hypermap/core/geometry/occupancy_votes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// Centres of the 4 x 4 cells of 1 cm of one block, in the lowest layer of block `x`.
std::vector<Eigen::Vector3f> sheet(int x) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(16);
  for (int i = 0; i < 16; ++i) {
    const int row = i / 4;
    const Eigen::Vector3f cell(static_cast<float>(4 * x + i % 4), static_cast<float>(row), 0.0F);
    points.emplace_back(0.01F * (cell.array() + 0.5F));
  }
  return points;
}

std::vector<Eigen::Vector3f> sheets(const std::vector<int>& blocks) {
  std::vector<Eigen::Vector3f> points;
  for (const int x : blocks) {
    const auto more = sheet(x);
    points.insert(points.end(), more.begin(), more.end());
  }
  return points;
}

/// So many observations of these blocks, which have nothing but `in_view` in view besides.
void see(OccupancyVotes& points,
         int times,
         const std::vector<int>& blocks,
         const std::vector<int>& in_view = {},
         std::uint32_t num_looks_from_there = 0) {
  const auto is_in_view = [&](const Eigen::Vector3d& centre) {
    EXPECT_NEAR(centre.y(), 0.02, 1e-12);  // of the block of 4 cm
    return std::ranges::count(in_view, static_cast<int>(std::floor(centre.x() / 0.04))) > 0;
  };
  for (int i = 0; i < times; ++i) {
    points.observe(sheets(blocks));
    points.look(sheets(blocks), is_in_view, num_looks_from_there);
  }
}

std::vector<PointVote> looks_at(const std::vector<std::pair<int, std::uint32_t>>& blocks) {
  std::vector<PointVote> out;
  out.reserve(blocks.size());
  for (const auto& [x, looks] : blocks) out.push_back({{x, 0, 0}, looks});
  return out;
}

/// The highest x that counts, in cells.
int last_column(const OccupancyVotes& points) {
  return points.agreement().high.x;
}

TEST(BlockLooks, AreCountedForWhatWasNotInViewEachTime) {
  OccupancyVotes points;
  see(points, 3, {0, 1});
  EXPECT_TRUE(points.state().looks.empty());  // both were in view of all
  see(points, 2, {0});                        // 1 is hidden
  EXPECT_EQ(points.state().looks, looks_at({{1, 3}}));
  see(points, 1, {0}, {1});  // 1 is in view, and no segment's
  EXPECT_EQ(points.state().looks, looks_at({{1, 4}}));
  see(points, 1, {1, 2});  // 0 is hidden; of 2 this is the first
  EXPECT_EQ(points.state().looks, looks_at({{0, 6}, {1, 5}, {2, 1}}));
  EXPECT_EQ(points.state().num_observations, 7U);
}

TEST(BlockLooks, ANewBlockWasInViewOfWhatLookedFromThere) {
  OccupancyVotes points;
  see(points, 10, {0});
  see(points, 1, {0, 1}, {}, 4);
  EXPECT_EQ(points.state().looks, looks_at({{1, 5}}));
  see(points, 1, {0, 2}, {}, 1000);  // never more than there were
  EXPECT_EQ(points.state().looks, looks_at({{1, 5}}));
}

TEST(BlockLooks, WhoDoesNotLookHasAllInView) {
  OccupancyVotes points;
  see(points, 2, {0});
  see(points, 1, {0, 1});
  EXPECT_EQ(points.state().looks, looks_at({{1, 1}}));
  points.observe(sheet(0));
  EXPECT_EQ(points.state().looks, looks_at({{1, 2}}));
}

TEST(BlockLooks, ASideThatFewLookedAtCounts) {
  // The front has 43 x 16 votes, a typical block's; a tenth of it is 68.8. Three observations of
  // the side give 48: of 43 they are too few, of the 3 that had it in view 4.8 is asked.
  OccupancyVotes points;
  see(points, 40, {0});
  see(points, 3, {0, 5});
  EXPECT_EQ(points.state().looks, looks_at({{5, 3}}));
  EXPECT_EQ(last_column(points), 23);
  OccupancyVotes unlooked;
  for (int i = 0; i < 40; ++i) unlooked.observe(sheet(0));
  for (int i = 0; i < 3; ++i) unlooked.observe(sheets({0, 5}));
  EXPECT_EQ(last_column(unlooked), 3);
}

TEST(BlockLooks, WhatTwoTookInIsAStrayHoweverFewLooked) {
  OccupancyVotes points;
  see(points, 40, {0});
  see(points, 2, {0, 5});
  EXPECT_EQ(last_column(points), 3);
}

TEST(BlockLooks, WhatOthersLookedAtInVainIsAStray) {
  // Of 100 observations a tenth of 1600 votes is asked, of 20 that looked 32; the block has 80.
  OccupancyVotes points;
  see(points, 80, {0});
  see(points, 5, {0, 5});
  see(points, 15, {0}, {5});
  EXPECT_EQ(last_column(points), 23);
  see(points, 1, {0}, {5});  // a cell has the votes of 5 of 21: less than a quarter
  EXPECT_EQ(last_column(points), 3);
}

TEST(BlockLooks, WhatHasTooFewVotesOfThoseThatLookedIsAStray) {
  // A cell has the votes of 6 of 24, but the block has no more: of 84 observations 134.4 are asked,
  // of 24 of them 38.4.
  OccupancyVotes points;
  see(points, 60, {0});
  auto corner = sheet(5);
  corner.resize(1);
  const auto front = sheet(0);
  corner.insert(corner.end(), front.begin(), front.end());
  for (int i = 0; i < 6; ++i) {
    points.observe(corner);
    points.look(
        corner, [](const Eigen::Vector3d&) { return false; }, 0);
  }
  see(points, 18, {0}, {5});
  EXPECT_EQ(points.state().looks, looks_at({{5, 24}}));
  EXPECT_EQ(last_column(points), 3);
}

TEST(BlockLooks, AddWhereObjectsMerge) {
  OccupancyVotes a;
  see(a, 4, {0});
  see(a, 2, {0, 1});  // 1: 2 of 6
  OccupancyVotes b;
  see(b, 3, {1});
  see(b, 1, {1, 2});  // 2: 1 of 4
  a.merge(b);
  // 0 has 6 of its own and 4 that had no point there; 1 has 2 and 4; 2 has 6 and 1.
  EXPECT_EQ(a.state().looks, looks_at({{1, 6}, {2, 7}}));
}

TEST(BlockLooks, OfAWideBlockAreThoseOfItsPartThatWasSeenMost) {
  OccupancyVotes points(OccupancyVotesOptions{.max_cells = 64});
  see(points, 3, {0, 1});
  see(points, 1, {0, 4});
  EXPECT_EQ(points.state().looks, looks_at({{1, 3}, {4, 1}}));
  points.observe(sheets({0, 6, 8}));  // 80 cells are too many: now of 2 cm
  ASSERT_NEAR(points.state().edge_m, 0.02, 1e-12);
  // 0 and 1 are one block, which all had in view; nobody looked with the fifth.
  EXPECT_EQ(points.state().looks, looks_at({{2, 2}}));
}

TEST(BlockLooks, GoFromBlocksToCellsAndBack) {
  OccupancyVotes points;
  see(points, 3, {0, 1});
  see(points, 2, {0, 3});
  const OccupancyVotesState& state = points.state();
  const auto by_cell = looks_of_cells(state);
  ASSERT_EQ(by_cell.size(), 48U);
  EXPECT_EQ(std::ranges::count(by_cell, 5U), 16);
  EXPECT_EQ(std::ranges::count(by_cell, 3U), 16);
  EXPECT_EQ(std::ranges::count(by_cell, 2U), 16);
  EXPECT_EQ(looks_of_blocks(state.votes, by_cell, state.num_observations), state.looks);
}

TEST(BlockLooks, ComeBackFromAStateAndNonsenseIsRefused) {
  OccupancyVotes points;
  see(points, 3, {0, 1});
  see(points, 2, {0, 3});
  EXPECT_EQ(OccupancyVotes::from_state({}, points.state()).value(), points);
  const auto refusal = [&](const std::vector<PointVote>& looks) {
    OccupancyVotesState state = points.state();
    state.looks = looks;
    const auto made = OccupancyVotes::from_state({}, state);
    return made ? std::string() : made.error().field;
  };
  EXPECT_EQ(refusal(looks_at({{0, 4}})), "");
  EXPECT_EQ(refusal(looks_at({{0, 5}})), "points.looks[0]");  // as many as there are
  EXPECT_EQ(refusal(looks_at({{0, 2}, {1, 0}})), "points.looks[1]");
  EXPECT_EQ(refusal(looks_at({{1, 2}, {1, 2}})), "points.looks[1]");
  EXPECT_EQ(refusal(std::vector<PointVote>(20000, PointVote{{0, 0, 0}, 1})), "points.looks");
}

}  // namespace
}  // namespace hypermap

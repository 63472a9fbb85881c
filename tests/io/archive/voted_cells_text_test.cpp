// SPDX-License-Identifier: BSD-3-Clause
#include "objects/voted_cells_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kEnough = 100'000;

std::string text_error(const VotedCellsText& text, std::uint32_t max_cells = kEnough) {
  const auto cells = voted_cells(text, max_cells);
  return cells ? "no error" : cells.error().field + " " + cells.error().what;
}

TEST(VotedCellsText, MasksAndVotesAreThoseOfTheHand) {
  // A cube of four cells at (-1, 5, 7). At its root the cells differ in bit 1: two in child 0 and
  // one in child 4 + 1, mask 0x21. Of the two one lies at x + 1: children 0 and 4, mask 0x11. The
  // third is at x + 3, z + 2: child 4 of its node, mask 0x10. 40 votes are 8 and 1 times 32.
  const std::vector<PointVote> votes{{{-1, 5, 7}, 1}, {{0, 5, 7}, 2}, {{2, 5, 9}, 40}};
  const VotedCellsText text{.origin = {-1, 5, 7}, .levels = 2, .masks = "211110", .votes = "BCoB"};
  EXPECT_EQ(voted_cells(text, kEnough).value(), votes);
}

TEST(VotedCellsText, NoCellsAndOneCellNeedNoMasks) {
  EXPECT_TRUE(voted_cells(VotedCellsText{}, kEnough).value().empty());
  const std::vector<PointVote> one{{{4, -4, 0}, 31}};
  const VotedCellsText text{.origin = {4, -4, 0}, .levels = 0, .masks = "", .votes = "f"};
  EXPECT_EQ(voted_cells(text, kEnough).value(), one);
}

TEST(VotedCellsText, WhatIsNeverWrittenIsRefused) {
  // Cells (0, 0, 0) and (1, 0, 0) with 1 and 2 votes.
  const VotedCellsText good{.origin = {0, 0, 0}, .levels = 1, .masks = "11", .votes = "BC"};
  ASSERT_EQ(text_error(good), "no error");
  const auto changed = [&](auto change) {
    VotedCellsText text = good;
    change(text);
    return text_error(text);
  };
  EXPECT_THAT(changed([](auto& t) { t.masks = "1"; }), HasSubstr("cells ends"));
  EXPECT_THAT(changed([](auto& t) { t.masks = "00"; }), HasSubstr("cells ends, or has no mask"));
  EXPECT_THAT(changed([](auto& t) { t.masks = "1G"; }), HasSubstr("no mask"));
  EXPECT_THAT(changed([](auto& t) { t.masks = "1100"; }), HasSubstr("cells has digits beyond"));
  EXPECT_THAT(changed([](auto& t) { t.votes = "B"; }), HasSubstr("votes ends"));
  EXPECT_THAT(changed([](auto& t) { t.votes = "B-"; }), HasSubstr("votes ends"));
  EXPECT_THAT(changed([](auto& t) { t.votes = "BCD"; }), HasSubstr("votes has digits beyond"));
  EXPECT_THAT(changed([](auto& t) { t.votes = "B//////H"; }), HasSubstr("no number of 32 bits"));
  EXPECT_THAT(changed([](auto& t) { t.levels = 33; }),
              HasSubstr("levels must be in 0 .. 32, is 33"));
  EXPECT_THAT(changed([](auto& t) { t.origin.x = std::numeric_limits<std::int32_t>::max(); }),
              HasSubstr("cells has a cell beyond 2^31"));
  EXPECT_THAT(text_error(good, 1), HasSubstr("votes are of more cells than max_cells = 1"));
}

}  // namespace
}  // namespace hypermap

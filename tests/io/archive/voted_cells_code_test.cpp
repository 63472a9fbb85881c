// SPDX-License-Identifier: BSD-3-Clause
#include "objects/voted_cells_code.hpp"

#include "hypermap/io/codec/checksum.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::HasSubstr;

constexpr std::uint32_t kAnyNumberOfCells = 100'000;

std::string code_error(const VotedCellsCode& code, std::uint32_t max_cells = kAnyNumberOfCells) {
  const auto cells = voted_cells(code, max_cells);
  return cells ? "no error" : cells.error().field + " " + cells.error().what;
}

/// A wall of `width` x `width` cells at y = 7, each with so many votes as x has.
std::vector<PointVote> wall(std::int32_t width) {
  std::vector<PointVote> votes;
  for (std::int32_t x = 1; x <= width; ++x) {
    for (std::int32_t z = 0; z < width; ++z)
      votes.push_back({{x, 7, z}, static_cast<std::uint32_t>(x)});
  }
  return votes;
}

TEST(VotedCellsCode, BytesAreThoseOfTheHand) {
  // Cells (0, 0, 0) and (1, 0, 0) with 1 vote each. Ten bits: children 0 to 7 are 1 0 0 0 1 0 0 0,
  // then for each cell that its votes have no second digit, 0. Every kind of bit is new and even,
  // but: children 1, 2 and 3 are each of a kind of their own, as 4, 5, 6 and 7 are; the second
  // cell has one with votes beside it down x, the first has none, so their votes are of two kinds.
  // The interval of 1000'1000'00 is [0x77C0'0000, 0x77FF'FFFF] where 1 is the lower
  // half. Its first byte is out, 0x77; of the rest [0xC000'0000, 0xFFFF'FFFF] the byte after the
  // first is 0xC1.
  const std::vector<PointVote> votes{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}};
  const VotedCellsCode code = voted_cells_code(votes);
  EXPECT_EQ(code.levels, 1);
  EXPECT_EQ(code.num_cells, 2U);
  EXPECT_EQ(code.bytes, "\x77\xC1");
  EXPECT_EQ(voted_cells(code, kAnyNumberOfCells).value(), votes);
}

TEST(VotedCellsCode, NoCellsHaveNoBytesAndOneCellHasItsVotesAlone) {
  EXPECT_EQ(voted_cells_code({}).bytes, "");
  EXPECT_EQ(voted_cells_code({}).num_cells, 0U);
  EXPECT_TRUE(voted_cells(VotedCellsCode{}, kAnyNumberOfCells).value().empty());
  // One vote: the bit 0 at even odds leaves the upper half, whose first byte and 1 is 0x81.
  const std::vector<PointVote> one{{{4, -4, 0}, 1}};
  const VotedCellsCode code = voted_cells_code(one);
  EXPECT_EQ(code.origin, (PointCell{4, -4, 0}));
  EXPECT_EQ(code.levels, 0);
  EXPECT_EQ(code.bytes, "\x81");
  EXPECT_EQ(voted_cells(code, kAnyNumberOfCells).value(), one);
}

TEST(VotedCellsCode, AnyCellsAreReadAsTheyWere) {
  std::mt19937 engine(3);
  for (const std::int32_t reach : {1, 7, 100, 1 << 20, std::numeric_limits<std::int32_t>::max()}) {
    std::uniform_int_distribution<std::int32_t> coordinate(-reach, reach);
    std::uniform_int_distribution<std::uint32_t> bits(0, 31);
    std::set<PointCell> cells{{-reach, -reach, -reach}, {reach, reach, reach}};
    while (cells.size() < 20)
      cells.insert({coordinate(engine), coordinate(engine), coordinate(engine)});
    std::vector<PointVote> votes;
    votes.reserve(cells.size());
    for (const PointCell& cell : cells)
      votes.push_back({cell, std::numeric_limits<std::uint32_t>::max() >> bits(engine)});
    EXPECT_EQ(voted_cells(voted_cells_code(votes), kAnyNumberOfCells).value(), votes) << reach;
  }
}

TEST(VotedCellsCode, BytesAreThoseThatOlderArchivesHold) {
  // A thick curved surface and one cell far away, as the first program that wrote version 3 coded
  // them.
  std::mt19937 engine(23);
  std::set<PointCell> cells{{70'000, -5, 9}};
  for (int i = 0; i < 3000; ++i) {
    const auto x = static_cast<std::int32_t>(engine() % 40);
    const auto y = static_cast<std::int32_t>(engine() % 40);
    cells.insert({x, y, x * y / 64 + static_cast<std::int32_t>(engine() % 3)});
  }
  std::vector<PointVote> votes;
  votes.reserve(cells.size());
  for (const PointCell& cell : cells) {
    const std::uint32_t factor = cell.x % 7 != 0 ? 1 : 400;
    votes.push_back({cell, 1U + static_cast<std::uint32_t>(engine() % 5) * factor});
  }
  const VotedCellsCode code = voted_cells_code(votes);
  EXPECT_EQ(votes.size(), 2227U);
  EXPECT_EQ(code.levels, 17);
  EXPECT_EQ(code.bytes.size(), 1963U);
  EXPECT_EQ(crc32_of(code.bytes), 0xBEE3'5AC7U);
  EXPECT_EQ(voted_cells(code, kAnyNumberOfCells).value(), votes);
}

TEST(VotedCellsCode, ASurfaceTakesFewBitsAndNeverLessThanTwoACell) {
  // 64 x 64 cells at one height: were every child at even odds, 8 bits for each of 1365 nodes.
  const std::vector<PointVote> votes = wall(64);
  const VotedCellsCode code = voted_cells_code(votes);
  EXPECT_EQ(voted_cells(code, kAnyNumberOfCells).value(), votes);
  EXPECT_LT(code.bytes.size(), 2 * votes.size() / 3);
  std::vector<PointVote> same = votes;
  for (PointVote& vote : same) vote.votes = 1;
  const VotedCellsCode filled = voted_cells_code(same);
  EXPECT_EQ(filled.bytes.size(), votes.size() / kMaxCellsPerByte);
  EXPECT_EQ(filled.bytes.back(), '\0');
  EXPECT_EQ(voted_cells(filled, kAnyNumberOfCells).value(), same);
}

TEST(VotedCellsCode, WhatIsNeverWrittenIsRefused) {
  const VotedCellsCode good = voted_cells_code(wall(8));
  ASSERT_EQ(code_error(good), "no error");
  const auto changed = [&](auto change) {
    VotedCellsCode code = good;
    change(code);
    return code_error(code);
  };
  EXPECT_THAT(changed([](auto& c) { c.levels = 33; }),
              HasSubstr("levels must be in 0 .. 32, is 33"));
  EXPECT_THAT(changed([](auto& c) { c.levels = -1; }), HasSubstr("levels must be in 0 .. 32"));
  EXPECT_THAT(changed([](auto& c) { c.num_cells = 63; }),
              HasSubstr("bytes are of more than 63 cells"));
  EXPECT_THAT(changed([](auto& c) { c.num_cells = 65; }),
              HasSubstr("bytes are of 64 cells, expected 65"));
  EXPECT_THAT(changed([](auto& c) { c.num_cells = 0; }), HasSubstr("bytes are of no cells"));
  EXPECT_THAT(changed([](auto& c) { c.bytes += '\0'; }), HasSubstr("go on after the last cell"));
  EXPECT_THAT(changed([](auto& c) { c.bytes.resize(15); }), HasSubstr("too few for 64 cells, 15"));
  EXPECT_THAT(changed([](auto& c) { c.origin.x = std::numeric_limits<std::int32_t>::max(); }),
              HasSubstr("bytes have a cell beyond 2^31"));
  EXPECT_THAT(code_error(good, 63), HasSubstr("more cells than max_cells = 63, 64"));
}

TEST(VotedCellsCode, DamageIsRefusedOrOtherCellsAndNeverMoreThanSaid) {
  std::mt19937 engine(11);
  const VotedCellsCode good = voted_cells_code(wall(20));
  for (int round = 0; round < 2000; ++round) {
    VotedCellsCode code = good;
    char& byte = code.bytes[engine() % code.bytes.size()];
    byte = static_cast<char>(static_cast<unsigned char>(byte) ^ 1U << engine() % 8);
    if (round % 4 == 0) code.bytes.resize(engine() % code.bytes.size());
    const auto cells = voted_cells(code, kAnyNumberOfCells);
    if (!cells) continue;
    EXPECT_EQ(cells->size(), code.num_cells);
    EXPECT_TRUE(std::ranges::is_sorted(*cells));
    EXPECT_TRUE(std::ranges::all_of(*cells, [](const PointVote& v) { return v.votes > 0; }));
  }
}

}  // namespace
}  // namespace hypermap

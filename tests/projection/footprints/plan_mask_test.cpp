// SPDX-License-Identifier: BSD-3-Clause
#include "footprints/plan_mask.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {
namespace {

/// Rows from the highest to the lowest, '#' is set.
PlanMask mask_of(const std::vector<std::string>& rows) {
  const int num_rows = static_cast<int>(rows.size());
  PlanMask mask(static_cast<int>(rows.front().size()), num_rows);
  for (int row = 0; row < num_rows; ++row) {
    for (int col = 0; col < mask.cols(); ++col) {
      const std::string& line = rows[static_cast<std::size_t>(num_rows - 1 - row)];
      mask.set(col, row, line[static_cast<std::size_t>(col)] == '#');
    }
  }
  return mask;
}

PlanMask random_mask(std::mt19937& random, int cols, int rows, double share) {
  std::bernoulli_distribution is_set(share);
  PlanMask mask(cols, rows);
  for (int row = 0; row < rows; ++row) {
    for (int col = 0; col < cols; ++col) mask.set(col, row, is_set(random));
  }
  return mask;
}

bool is_within(const PlanMask& mask, int col, int row, int radius, bool value) {
  for (int r = 0; r < mask.rows(); ++r) {
    for (int c = 0; c < mask.cols(); ++c) {
      const int squared = (c - col) * (c - col) + (r - row) * (r - row);
      if (mask.at(c, r) == value && squared <= radius * radius) return true;
    }
  }
  return false;
}

TEST(PlanMask, DilationAndErosionAreWhatEachPixelSeesWithinTheDisc) {
  std::mt19937 random(7);
  for (const int radius : {0, 1, 2, 5, 40}) {
    for (const double share : {0.02, 0.5, 0.97}) {
      const PlanMask mask = random_mask(random, 23, 17, share);
      const PlanMask wide = dilated(mask, radius);
      const PlanMask thin = eroded(mask, radius);
      for (int row = 0; row < mask.rows(); ++row) {
        for (int col = 0; col < mask.cols(); ++col) {
          ASSERT_EQ(wide.at(col, row), is_within(mask, col, row, radius, true));
          ASSERT_EQ(thin.at(col, row), !is_within(mask, col, row, radius, false));
        }
      }
    }
  }
}

TEST(PlanMask, ClosingFillsNarrowGapsAndOpeningRemovesWhatIsThin) {
  const PlanMask gap = mask_of({".........", "..##.##..", "..##.##..", "..##.##..", "........."});
  const PlanMask whole = mask_of({".........", "..##.##..", "..#####..", "..##.##..", "........."});
  EXPECT_EQ(closed(gap, 1), whole) << "the disc of radius 1 is a plus";
  const PlanMask tail =
      mask_of({"..........", "..###.....", "..#######.", "..###.....", ".........."});
  EXPECT_EQ(opened(tail, 1).count(), 8U) << "two pluses side by side";
  EXPECT_FALSE(opened(tail, 1).at(7, 2));
}

TEST(PlanMask, WhatIsEnclosedIsAHoleAndWhatLeadsOutIsNot) {
  const PlanMask ring = mask_of({"####.", "#..#.", "#..#.", "####."});
  EXPECT_EQ(with_holes_filled(ring), mask_of({"####.", "####.", "####.", "####."}));
  const PlanMask open = mask_of({"##.#", "#..#", "####"});
  EXPECT_EQ(with_holes_filled(open), open);
  EXPECT_EQ(with_holes_filled(mask_of({".#.", "#.#", ".#."})).count(), 5U)
      << "paths go over edges, not over corners";
}

TEST(PlanMask, NoTwoPixelsAreLeftThatTouchInACornerAlone) {
  std::mt19937 random(3);
  for (int run = 0; run < 20; ++run) {
    const PlanMask mask = random_mask(random, 30, 20, 0.4);
    const PlanMask out = without_corner_contacts(mask);
    for (int row = 0; row + 1 < mask.rows(); ++row) {
      for (int col = 0; col + 1 < mask.cols(); ++col) {
        const bool a = out.at(col, row);
        const bool b = out.at(col + 1, row);
        ASSERT_FALSE(a == out.at(col + 1, row + 1) && b == out.at(col, row + 1) && a != b);
        ASSERT_TRUE(out.at(col, row) || !mask.at(col, row)) << "only adds";
      }
    }
  }
}

TEST(PlanMask, SpecksGoAndPartsThatAreLargeEnoughStay) {
  const PlanMask mask = mask_of({"####..#", "####...", "####.##", ".....##"});
  const MaskParts large = without_specks(mask, 0.5);
  EXPECT_EQ(large.num_parts, 1U);
  EXPECT_EQ(large.mask.count(), 12U);
  const MaskParts two = without_specks(mask, 4.0 / 12.0);
  EXPECT_EQ(two.num_parts, 2U) << "exactly the share stays";
  EXPECT_EQ(two.mask.count(), 16U);
  EXPECT_EQ(without_specks(mask, 0.0).num_parts, 3U);
  EXPECT_EQ(without_specks(PlanMask(3, 3), 0.5).num_parts, 0U);
  EXPECT_EQ(without_specks(PlanMask(0, 0), 0.5).num_parts, 0U);
}

}  // namespace
}  // namespace hypermap

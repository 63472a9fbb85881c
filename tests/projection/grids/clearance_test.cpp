// SPDX-License-Identifier: BSD-3-Clause
#include "grids/clearance.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

/// By all cells that are not in the mask, with those around the grid where they are out.
std::int64_t by_brute_force(const CellMask& mask, int col, int row, BeyondGrid beyond) {
  const std::int64_t far = mask.cols + mask.rows + 2;
  std::int64_t nearest = far * far;
  for (int r = -1; r <= mask.rows; ++r) {
    for (int c = -1; c <= mask.cols; ++c) {
      const bool is_outside = r < 0 || c < 0 || r == mask.rows || c == mask.cols;
      const auto place = static_cast<std::size_t>(r) * static_cast<std::size_t>(mask.cols) +
                         static_cast<std::size_t>(c);
      if (is_outside ? beyond == BeyondGrid::kIn : mask.is_in[place] != 0) continue;
      const std::int64_t dr = r - row;
      const std::int64_t dc = c - col;
      nearest = std::min(nearest, dr * dr + dc * dc);
    }
  }
  return nearest;
}

TEST(SquaredClearance, OfARowIsTheDistanceToItsNearerEnd) {
  const CellMask mask{.cols = 7, .rows = 1, .is_in = {0, 1, 1, 1, 1, 1, 0}};
  // Above and below the one row lies the outside, one cell away.
  EXPECT_THAT(squared_clearance(mask), testing::ElementsAre(0, 1, 1, 1, 1, 1, 0));
  EXPECT_THAT(squared_clearance({.cols = 0, .rows = 0, .is_in = {}}), testing::IsEmpty());
}

TEST(SquaredClearance, IsThatOfBruteForce) {
  for (int seed = 0; seed < test::repetitions(20); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 1);
    CellMask mask{.cols = static_cast<int>(1 + rng.below(25)),
                  .rows = static_cast<int>(1 + rng.below(25)),
                  .is_in = {}};
    const double share = seed % 3 == 0 ? 1.0 : rng.uniform(0.5, 0.99);
    for (int i = 0; i < mask.cols * mask.rows; ++i) mask.is_in.push_back(rng.chance(share) ? 1 : 0);
    const BeyondGrid beyond = seed % 2 == 0 ? BeyondGrid::kOut : BeyondGrid::kIn;
    const auto clearance = squared_clearance(mask, beyond);
    for (int row = 0; row < mask.rows; ++row) {
      for (int col = 0; col < mask.cols; ++col) {
        const auto place = static_cast<std::size_t>(row) * static_cast<std::size_t>(mask.cols) +
                           static_cast<std::size_t>(col);
        const std::int64_t expected =
            mask.is_in[place] == 0 ? 0 : by_brute_force(mask, col, row, beyond);
        ASSERT_EQ(clearance[place], expected) << seed << ": " << col << ", " << row;
      }
    }
  }
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "supercells/contour_reward.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hypermap {
namespace {

TEST(ContourReward, ByHand) {
  // 3 x 1 cells 0 0 1: patches of 2, 3 and 2 cells: 1, (4 + 1) / 9, (1 + 1) / 4.
  EXPECT_DOUBLE_EQ(contour_reward(3, 1, std::vector<std::int32_t>{0, 0, 1}), 1.0 + 5.0 / 9 + 0.5);
  EXPECT_DOUBLE_EQ(contour_reward(3, 2, std::vector<std::int32_t>(6, 4)), 6.0);
}

TEST(ContourReward, ThePullsOfTwoLabelsAreTheChange) {
  // On grids that blocks cut off at their edges, against G anew.
  for (const auto& size : {std::pair{11, 7}, {1, 9}, {2, 2}, {16, 5}}) {
    const int cols = size.first;
    const int rows = size.second;
    for (int level = 0; level < 3; ++level) {
      const ContourPull pull(cols, rows, level);
      CounterRng random(static_cast<std::uint64_t>(cols), static_cast<std::uint64_t>(level));
      for (int trial = 0; trial < 30; ++trial) {
        std::vector<std::int32_t> labels;
        labels.reserve(static_cast<std::size_t>(cols) * static_cast<std::size_t>(rows));
        for (int i = 0; i < cols * rows; ++i) {
          labels.push_back(static_cast<std::int32_t>(random.below(3)));
        }
        const int edge = 1 << level;
        const auto block_cols = static_cast<std::uint32_t>((cols + edge - 1) / edge);
        const auto block_rows = static_cast<std::uint32_t>((rows + edge - 1) / edge);
        const Block block{static_cast<int>(random.below(block_cols)),
                          static_cast<int>(random.below(block_rows))};
        const auto fill = [&](std::int32_t label) {
          for (int y = block.row * edge; y < std::min((block.row + 1) * edge, rows); ++y) {
            for (int x = block.col * edge; x < std::min((block.col + 1) * edge, cols); ++x) {
              labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(cols) +
                     static_cast<std::size_t>(x)] = label;
            }
          }
        };
        fill(0);
        const double change = pull.of(2, block, labels) - pull.of(0, block, labels);
        const double before = contour_reward(cols, rows, labels);
        fill(2);
        ASSERT_NEAR(contour_reward(cols, rows, labels) - before, change, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace hypermap

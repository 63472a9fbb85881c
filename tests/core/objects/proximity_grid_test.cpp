// SPDX-License-Identifier: BSD-3-Clause
#include "objects/association/proximity_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace hypermap {
namespace {

bool is_near_one(const ProximityCell& cell, const std::vector<ProximityCell>& cells) {
  return std::any_of(cells.begin(), cells.end(), [&](const ProximityCell& other) {
    return std::abs(cell.x - other.x) <= 1 && std::abs(cell.y - other.y) <= 1 &&
           std::abs(cell.z - other.z) <= 1;
  });
}

std::vector<ProximityCell> random_cells(std::mt19937& random, int count, std::int64_t size) {
  std::uniform_int_distribution<std::int64_t> at(-size, size);
  std::vector<ProximityCell> cells;
  cells.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) cells.push_back({at(random), at(random), at(random) * 4});
  return cells;
}

TEST(ProximityGrid, KnowsWhatAComparisonOneByOneKnows) {
  std::mt19937 random(5);
  std::size_t num_near = 0;
  for (int round = 0; round < 60; ++round) {
    const std::int64_t size = 1 + round;  // rows of one word, then of several
    const auto cells = random_cells(random, 1 + 5 * round, size);
    const DenseNeighbourhood dense(cells, bounds_of(cells));
    const SparseNeighbourhood sparse(cells);
    const ProximityGrid grid(cells);
    std::vector<ProximityCell> asked = random_cells(random, 200, size + 3);
    for (int i = 0; i < 200; ++i) {  // around the cells, up to two away
      const ProximityCell& cell = cells[random() % cells.size()];
      const auto offset = [&] { return static_cast<std::int64_t>(random() % 5) - 2; };
      asked.push_back({cell.x + offset(), cell.y + offset(), cell.z + offset()});
    }
    for (const ProximityCell& cell : asked) {
      const bool expected = is_near_one(cell, cells);
      num_near += expected ? 1U : 0U;
      ASSERT_EQ(dense.contains(cell), expected) << round;
      ASSERT_EQ(sparse.contains(cell), expected) << round;
      ASSERT_EQ(grid.is_near(cell), expected) << round;
    }
  }
  EXPECT_GT(num_near, 1000U);
}

TEST(ProximityGrid, ACellReachesItsTwentySixNeighboursAcrossAllWords) {
  // 150 cells along z are three words; the reach crosses from one to the next.
  const ProximityCell far{0, 0, -75};
  for (std::int64_t z = -75; z <= 75; ++z) {
    const std::vector<ProximityCell> cells{far, {3, -4, z}};
    const DenseNeighbourhood dense(cells, bounds_of(cells));
    constexpr std::int64_t kNumCells = 343;  // 7 on each axis
    for (std::int64_t i = 0; i < kNumCells; ++i) {
      const ProximityCell cell{i / 49, -7 + i / 7 % 7, z - 3 + i % 7};
      ASSERT_EQ(dense.contains(cell), is_near_one(cell, cells)) << z << ' ' << i;
    }
  }
}

TEST(ProximityGrid, CellsFarApartTakeNoMoreMemoryThanTheirNumber) {
  constexpr std::int64_t kFar = 1'000'000;
  const std::vector<ProximityCell> cells{{-kFar, kFar, 0}, {kFar, -kFar, kFar}};
  EXPECT_GT(DenseNeighbourhood::num_words(bounds_of(cells)), 1e15);
  const ProximityGrid grid(cells);
  EXPECT_TRUE(grid.is_near({kFar - 1, 1 - kFar, kFar}));
  EXPECT_FALSE(grid.is_near({kFar - 2, 1 - kFar, kFar}));
  EXPECT_FALSE(grid.is_near({0, 0, 0}));
}

TEST(ProximityGrid, SharesAreCountedOverAllCells) {
  const ProximityGrid grid(std::vector<ProximityCell>{{0, 0, 0}});
  EXPECT_EQ(grid.share_near({}), 0.0);
  EXPECT_EQ(grid.share_near(std::vector<ProximityCell>{{1, 1, 1}, {2, 0, 0}, {0, 9, 0}, {0, 0, 0}}),
            0.5);
  EXPECT_EQ(ProximityGrid().share_near(std::vector<ProximityCell>{{0, 0, 0}}), 0.0);
  EXPECT_EQ(
      ProximityGrid(std::vector<ProximityCell>{}).share_near(std::vector<ProximityCell>{{0, 0, 0}}),
      0.0);
}

TEST(ProximityGrid, PointsFallIntoCellsByTheFloor) {
  EXPECT_EQ(proximity_cell_of({-0.001, 0.049, 0.05}, 0.025), (ProximityCell{-1, 1, 2}));
}

}  // namespace
}  // namespace hypermap

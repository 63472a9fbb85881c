// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/near_cells.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

Polygon square_at(double x, double y, double side) {
  return make_polygon({{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}).value();
}

std::vector<Cell> near_cells(const GridGeometry& grid,
                             const std::vector<Polygon>& polygons,
                             double reach_cells) {
  std::vector<Cell> cells;
  EXPECT_TRUE(for_each_near_cell(
      grid, polygons, reach_cells, [&](Cell cell, double) { cells.push_back(cell); }));
  return cells;
}

// One cell is covered; the nearest edge of it is half a cell from the middles beside it, and
// sqrt(2) - 0.5 = 0.91 from those at its corners.
TEST(NearCells, AreThoseThatAShapeMeetsAndThoseAround) {
  const GridGeometry grid{.resolution_m = 1.0, .cols = 5, .rows = 5};
  const std::vector<Polygon> shape{square_at(2.25, 2.25, 0.5)};
  EXPECT_THAT(near_cells(grid, shape, 0.0), ElementsAre(Cell{2, 2}));
  EXPECT_THAT(near_cells(grid, shape, 0.5),
              ElementsAre(Cell{2, 1}, Cell{1, 2}, Cell{2, 2}, Cell{3, 2}, Cell{2, 3}));
  EXPECT_EQ(near_cells(grid, shape, 0.92).size(), 9U);
  EXPECT_EQ(near_cells(grid, shape, 100.0).size(), 25U);
  EXPECT_THAT(near_cells(grid, {}, 1.0), IsEmpty());
  EXPECT_THAT(near_cells({}, shape, 1.0), IsEmpty());
}

TEST(NearCells, AShapeBeyondTheGridReachesIntoIt) {
  const GridGeometry grid{.resolution_m = 1.0, .cols = 3, .rows = 1};
  const std::vector<Polygon> shape{square_at(-1.75, 0.25, 0.5)};  // in the second cell to the left
  EXPECT_THAT(near_cells(grid, shape, 1.4), IsEmpty());
  EXPECT_THAT(near_cells(grid, shape, 1.5), ElementsAre(Cell{0, 0}));
  EXPECT_THAT(near_cells(grid, shape, 2.5), ElementsAre(Cell{0, 0}, Cell{1, 0}));
  EXPECT_THAT(near_cells(grid, {square_at(-50.0, 0.0, 1.0)}, 2.5), IsEmpty());
}

TEST(NearCells, TooManyAreRefused) {
  const GridGeometry grid{.resolution_m = 1e-6, .cols = 3, .rows = 1};
  const std::vector<Polygon> shape{square_at(0.0, 0.0, 1.0)};
  const auto visited = for_each_near_cell(grid, shape, 1e8, [](Cell, double) {});
  ASSERT_FALSE(visited);
  EXPECT_EQ(visited.error().code, ErrorCode::kLimit);
}

/// Gaps of the cells within reach, by the cells that the polygons meet on a much larger grid.
std::map<Cell, double> gaps_by_brute_force(const GridGeometry& grid,
                                           const std::vector<Polygon>& polygons,
                                           double reach_cells) {
  constexpr int kMargin = 40;
  GridGeometry wide = grid;
  wide.origin = from_cells(grid, {-kMargin, -kMargin});
  wide.cols += 2 * kMargin;
  wide.rows += 2 * kMargin;
  std::map<Cell, double> gaps;
  const auto meet = [&](Cell met, double) {
    for (int row = 0; row < grid.rows; ++row) {
      for (int col = 0; col < grid.cols; ++col) {
        const double way = std::hypot(met.col - kMargin - col, met.row - kMargin - row) - 0.5;
        if (way > reach_cells) continue;
        const auto [known, is_new] = gaps.try_emplace(Cell{col, row}, way);
        if (!is_new && way < known->second) known->second = way;
      }
    }
  };
  for (const Polygon& polygon : polygons) for_each_covered_cell(wide, polygon, meet);
  return gaps;
}

TEST(NearCells, AreThoseOfBruteForceAtAnyYaw) {
  for (int seed = 0; seed < test::repetitions(20); ++seed) {
    CounterRng rng(static_cast<std::uint64_t>(seed), 7);
    const GridGeometry grid{.resolution_m = 0.5,
                            .origin = {rng.uniform(-1.0, 1.0), 0.3},
                            .yaw_rad = seed % 2 == 0 ? 0.0 : rng.uniform(-3.0, 3.0),
                            .cols = static_cast<int>(5 + rng.below(15)),
                            .rows = static_cast<int>(5 + rng.below(15))};
    std::vector<Polygon> shapes;
    shapes.reserve(3);
    for (int i = 0; i < 3; ++i) {
      shapes.push_back(
          square_at(rng.uniform(-8.0, 8.0), rng.uniform(-8.0, 8.0), rng.uniform(0.1, 3.0)));
    }
    const double reach_cells = rng.uniform(0.0, 9.0);
    std::map<Cell, double> gaps;
    ASSERT_TRUE(for_each_near_cell(
        grid, shapes, reach_cells, [&](Cell cell, double gap) { gaps.emplace(cell, gap); }));
    const auto expected = gaps_by_brute_force(grid, shapes, reach_cells);
    ASSERT_EQ(gaps.size(), expected.size()) << seed;
    for (const auto& [cell, gap] : expected) {
      ASSERT_NEAR(gaps.at(cell), gap, 1e-9) << seed << ": " << cell.col << ", " << cell.row;
    }
  }
}

}  // namespace
}  // namespace hypermap

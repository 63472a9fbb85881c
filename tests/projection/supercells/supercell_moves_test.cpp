// SPDX-License-Identifier: BSD-3-Clause
#include "supercells/supercell_moves.hpp"

#include "stack_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace hypermap {
namespace {

using test::cells_of;
using test::num_parts;
using test::random_stack;
using test::stack_from;

using Labels = std::vector<std::int32_t>;

/// D' of each supercell anew, or n^(3/4) sqrt(D') of n cells if they are weighted: in two passes
/// over them.
std::map<int, double> terms(const BinnedCells& cells, const Labels& labels, bool cell_weighted) {
  std::map<int, std::vector<std::size_t>> members;
  for (std::size_t i = 0; i < labels.size(); ++i) members[labels[i]].push_back(i);
  std::map<int, double> sums;
  for (const auto& [label, of_label] : members) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(cells.num_layers); ++n) {
      const auto centre = [&](std::size_t i) {
        return cells.of_cell(i)[n] / (2.0 * cells.num_bins);
      };
      double mean = 0.0;
      for (const std::size_t i : of_label) mean += centre(i);
      mean /= static_cast<double>(of_label.size());
      double square = 0.0;
      for (const std::size_t i : of_label) square += (centre(i) - mean) * (centre(i) - mean);
      sums[label] += square / static_cast<double>(of_label.size());
    }
    const auto size = static_cast<double>(of_label.size());
    if (cell_weighted) sums[label] = std::pow(size, 0.75) * std::sqrt(sums[label]);
  }
  return sums;
}

struct RandomWorld {
  int cols;
  int rows;
  int num_layers;
  int num_levels;
  double gamma;
  bool total;
  bool cell_weighted = false;
};

/// G anew: over all cells, the sum over labels of the squared share of a label in the 3 x 3 patch.
double contour(const BinnedCells& cells, const Labels& labels) {
  double sum = 0.0;
  for (int row = 0; row < cells.rows; ++row) {
    for (int col = 0; col < cells.cols; ++col) {
      std::map<int, double> counts;
      double total = 0.0;
      for (int y = row - 1; y <= row + 1; ++y) {
        for (int x = col - 1; x <= col + 1; ++x) {
          if (x < 0 || y < 0 || x >= cells.cols || y >= cells.rows) continue;
          ++counts[labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(cells.cols) +
                          static_cast<std::size_t>(x)]];
          ++total;
        }
      }
      for (const auto& [label, count] : counts) sum += count * count / (total * total);
    }
  }
  return sum;
}

double energy_anew(const BinnedCells& cells, const Labels& labels, const RandomWorld& world) {
  double sum = 0.0;
  for (const auto& [label, term] : terms(cells, labels, world.cell_weighted)) sum += term;
  return sum - world.gamma * contour(cells, labels);
}

/// Neighbours that may get the block.
std::vector<int> takers(const SupercellMoves& moves, Block block) {
  std::vector<int> found;
  for (const int label : moves.labels_beside(block)) {
    if (label >= 0 && label != moves.label(block)) found.push_back(label);
  }
  return found;
}

class SupercellMovesOn : public testing::TestWithParam<RandomWorld> {};

TEST_P(SupercellMovesOn, EachMoveKeepsTheEnergyAndTheConnectednessThatWouldBeFoundAnew) {
  // [sogm] Eq. (7), Eq. (10): H by increments against H anew after every one of many random
  // moves, and what a move was said to bring against the difference that it made.
  const RandomWorld& world = GetParam();
  const GridGeometry geometry = cells_of(world.cols, world.rows);
  const BinnedCells cells = binned(random_stack(geometry, world.num_layers, 3), 16);
  SupercellMoves moves(cells,
                       {.num_levels = world.num_levels,
                        .contour_weight = world.gamma,
                        .total = world.total,
                        .cell_weighted = world.cell_weighted});
  const bool counts_both = world.total || world.cell_weighted;
  EXPECT_NEAR(moves.energy(), energy_anew(cells, moves.labels(), world), 1e-9);
  CounterRng random(17, 5);
  int num_moves = 0;
  for (int level = world.num_levels - 1; level >= 0; --level) {
    moves.set_level(level);
    for (int i = 0; i < 150; ++i) {
      const Block block{
          static_cast<int>(random.below(static_cast<std::uint32_t>(moves.block_cols()))),
          static_cast<int>(random.below(static_cast<std::uint32_t>(moves.block_rows())))};
      const std::vector<int> to_choose = takers(moves, block);
      if (to_choose.empty() || !moves.may_leave(block)) continue;
      const int from = moves.label(block);
      const int to = to_choose[random.below(static_cast<std::uint32_t>(to_choose.size()))];
      auto before = terms(cells, moves.labels(), world.cell_weighted);
      const double contour_before = contour(cells, moves.labels());
      const double promised = moves.energy_change(block, to);
      moves.move(block, to);
      ++num_moves;
      auto after = terms(cells, moves.labels(), world.cell_weighted);
      const double made = after[to] - before[to] +
                          (counts_both ? after[from] - before[from] : 0.0) -
                          world.gamma * (contour(cells, moves.labels()) - contour_before);
      ASSERT_NEAR(promised, made, 1e-9);
      ASSERT_NEAR(moves.energy(), energy_anew(cells, moves.labels(), world), 1e-9);
      ASSERT_EQ(moves.label(block), to);
      for (const int label : {from, to}) {
        ASSERT_EQ(num_parts(geometry, moves.labels(), label), 1) << label;
      }
    }
  }
  EXPECT_GT(num_moves, 50);
  for (int label = 0; label < moves.count(); ++label) {
    EXPECT_EQ(num_parts(geometry, moves.labels(), label), 1);
  }
}

INSTANTIATE_TEST_SUITE_P(RandomWorlds,
                         SupercellMovesOn,
                         testing::Values(RandomWorld{24, 16, 2, 2, 0.0, false},
                                         RandomWorld{24, 16, 2, 2, 0.01, true},
                                         RandomWorld{37, 9, 1, 2, 0.003, false},
                                         RandomWorld{11, 30, 5, 3, 0.5, true},
                                         RandomWorld{19, 19, 3, 1, 0.02, false},
                                         RandomWorld{24, 16, 2, 2, 0.0, false, true},
                                         RandomWorld{37, 9, 1, 2, 0.003, false, true},
                                         RandomWorld{11, 30, 8, 3, 0.5, true, true},
                                         RandomWorld{5, 41, 3, 1, 0.02, false, true}));

/// The neighbour that best_taker shall find, by asking all of them each time.
std::optional<int> best_of_all(SupercellMoves& moves, Block block) {
  if (!moves.may_leave(block)) return std::nullopt;
  std::optional<int> best;
  double best_change = -1e-12;
  std::vector<int> in_order = takers(moves, block);
  std::ranges::sort(in_order);
  for (const int to : in_order) {
    const double change = moves.energy_change(block, to);
    if (change >= best_change) continue;
    best = to;
    best_change = change;
  }
  return best;
}

TEST_P(SupercellMovesOn, BlocksThatAreNotAskedAgainWouldNotMove) {
  const RandomWorld& world = GetParam();
  const BinnedCells cells =
      binned(random_stack(cells_of(world.cols, world.rows), world.num_layers, 5), 16);
  SupercellMoves moves(cells,
                       {.num_levels = world.num_levels,
                        .contour_weight = world.gamma,
                        .total = world.total,
                        .cell_weighted = world.cell_weighted});
  int num_moves = 0;
  for (int level = world.num_levels - 1; level >= 0; --level) {
    moves.set_level(level);
    for (int pass = 0; pass < 4; ++pass) {
      for (int row = 0; row < moves.block_rows(); ++row) {
        for (int col = 0; col < moves.block_cols(); ++col) {
          const auto expected = best_of_all(moves, {col, row});
          ASSERT_EQ(moves.best_taker({col, row}), expected);
          if (!expected) continue;
          moves.move({col, row}, *expected);
          ++num_moves;
        }
      }
    }
  }
  const bool is_stiff = world.gamma > 0.1;  // no move makes up for a rougher outline
  EXPECT_GT(num_moves, is_stiff ? -1 : 20);
}

TEST(SupercellMoves, SquaresAtTheEndTakeWhatIsLeftOver) {
  // 11 x 6 cells, squares of 4: two side by side, one high; the last ones are 7 wide and 6 high.
  const BinnedCells cells = binned(random_stack(cells_of(11, 6), 1, 2), 16);
  const SupercellMoves moves(cells, {.num_levels = 2});
  EXPECT_EQ(moves.count(), 2);
  EXPECT_EQ(std::ranges::count(moves.labels(), 0), 24);
  EXPECT_EQ(moves.block_cols(), 6);  // of 2 cells, the last one of 1
  EXPECT_EQ(moves.block_rows(), 3);
  EXPECT_EQ(moves.label({1, 2}), 0);
  EXPECT_EQ(moves.label({2, 0}), 1);
}

TEST(SupercellMoves, ABridgeMayNotLeave) {
  // Squares of 2 x 2 cells: 0 | 1. Cells of 0 go until it is bent around a corner:
  //   row 1:  0 1        row 1:  0 1
  //   row 0:  0 0        then (0, 0) is the bridge between (0, 1) and (1, 0).
  const GridStack stack = stack_from(cells_of(4, 2), 1, [](int /*layer*/, Cell cell) {
    return 0.1 + 0.2 * ((cell.col + cell.row) % 3);
  });
  const BinnedCells cells = binned(stack, 16);
  SupercellMoves moves(cells, {.num_levels = 1});
  ASSERT_EQ(moves.count(), 2);
  ASSERT_TRUE(moves.may_leave({1, 1}));
  moves.move({1, 1}, 1);
  EXPECT_FALSE(moves.may_leave({0, 0}));
  ASSERT_TRUE(moves.may_leave({1, 0}));
  EXPECT_TRUE(moves.may_leave({0, 1}));
  moves.move({1, 0}, 1);
  EXPECT_TRUE(moves.may_leave({0, 0}));
}

TEST(SupercellMoves, WhatHasNoVarianceDoesNotShrink) {
  // [sogm] III-D.2: the left square is of one value, the right one of two.
  const GridStack stack = stack_from(
      cells_of(4, 2), 1, [](int /*layer*/, Cell cell) { return cell.col < 3 ? 0.9 : 0.1; });
  const BinnedCells cells = binned(stack, 16);
  SupercellMoves moves(cells, {.num_levels = 1});
  ASSERT_EQ(moves.count(), 2);
  for (const int row : {0, 1}) {
    EXPECT_FALSE(moves.may_leave({1, row}));
    EXPECT_TRUE(moves.may_leave({2, row}));
  }
}

TEST(SupercellMoves, TheLastBlockStays) {
  // Two squares of 4 x 4 cells; blocks of 2 x 2, each with a variance of its own.
  const GridStack stack = stack_from(cells_of(8, 4), 1, [](int /*layer*/, Cell cell) {
    return 0.1 + 0.1 * (cell.col % 3 + cell.row);
  });
  const BinnedCells cells = binned(stack, 16);
  SupercellMoves moves(cells, {.num_levels = 2});
  for (const Block block : {Block{1, 1}, Block{1, 0}, Block{0, 0}}) {
    ASSERT_TRUE(moves.may_leave(block));
    moves.move(block, 1);
  }
  EXPECT_EQ(std::ranges::count(moves.labels(), 0), 4);
  EXPECT_FALSE(moves.may_leave({0, 1}));
}

}  // namespace
}  // namespace hypermap

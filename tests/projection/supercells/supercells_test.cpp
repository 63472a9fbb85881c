// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/supercells/supercells.hpp"

#include "stack_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::cells_of;
using test::num_parts;
using test::random_stack;
using test::stack_from;

/// The printed rule; with both sides counted; with cells counted.
struct Form {
  bool total;
  bool cell_weighted;
};
constexpr Form kForms[] = {{false, false}, {true, false}, {false, true}};

/// Two objects on two layers, of no square's outline, in the middle of nothing, with noise.
int object_at(Cell cell) {
  const double x = cell.col - 20.0;
  const double y = cell.row - 15.0;
  if (x * x + y * y < 81.0) return 1;
  return cell.col + cell.row > 62 ? 2 : 0;
}

GridStack objects_stack(double noise) {
  CounterRng random(8, 1);
  return stack_from(cells_of(48, 33), 2, [&](int layer, Cell cell) {
    const double p = object_at(cell) == layer + 1 ? 0.85 : 0.15;
    return std::clamp(p + noise * random.normal(), 0.01, 0.99);
  });
}

/// The share of cells that are of the object most frequent in their supercell.
double pureness(const Supercells& supercells) {
  std::map<int, std::map<int, int>> counts;
  for (int row = 0; row < supercells.geometry.rows; ++row) {
    for (int col = 0; col < supercells.geometry.cols; ++col) {
      const std::size_t i = supercells.geometry.index({col, row});
      ++counts[supercells.labels[i]][object_at({col, row})];
    }
  }
  int right = 0;
  for (const auto& [label, of_object] : counts) {
    int most = 0;
    for (const auto& [object, count] : of_object) most = std::max(most, count);
    right += most;
  }
  return right / static_cast<double>(supercells.labels.size());
}

TEST(Supercells, FollowTheOutlinesOfObjects) {
  // [sogm] Eq. (7) to (10). Squares cut the objects' outlines; what the moves leave wrong is less.
  for (const Form form : kForms) {
    const SupercellOptions options{
        .num_levels = 3, .total = form.total, .cell_weighted = form.cell_weighted};
    const auto found = extract_supercells(objects_stack(0.05), options).value();
    Supercells squares = found;
    for (int row = 0; row < 33; ++row) {
      for (int col = 0; col < 48; ++col) {
        squares.labels[found.geometry.index({col, row})] = std::min(row / 8, 3) * 6 + col / 8;
      }
    }
    EXPECT_EQ(found.count, 24);
    EXPECT_LT(found.energy, found.first_energy);
    EXPECT_LT(1.0 - pureness(found), form.total ? 0.005 : 0.02);
    EXPECT_GT(1.0 - pureness(squares), 0.1);
  }
}

TEST(Supercells, WithBothSidesCountedCleanObjectsAreFoundExactly) {
  const auto found = extract_supercells(objects_stack(0.0), {.num_levels = 3, .total = true});
  EXPECT_EQ(pureness(found.value()), 1.0);
  EXPECT_LT(found->energy, 0.0);
}

TEST(Supercells, AreConnectedAndCoverEveryCellOnAnyStack) {
  for (const int num_layers : {1, 2, 6}) {
    for (const auto& [cols, rows] : {std::pair{33, 12}, {9, 50}, {16, 16}, {3, 40}, {65, 5}}) {
      const GridGeometry geometry = cells_of(cols, rows);
      for (const Form form : kForms) {
        const auto seed = static_cast<std::uint64_t>(cols) + static_cast<std::uint64_t>(num_layers);
        const auto found = extract_supercells(random_stack(geometry, num_layers, seed),
                                              {.num_levels = 2,
                                               .contour_weight = 0.001,
                                               .total = form.total,
                                               .cell_weighted = form.cell_weighted})
                               .value();
        const std::set<std::int32_t> labels(found.labels.begin(), found.labels.end());
        ASSERT_EQ(labels.size(), static_cast<std::size_t>(found.count));
        ASSERT_EQ(*labels.begin(), 0);
        ASSERT_EQ(*labels.rbegin(), found.count - 1);
        for (int label = 0; label < found.count; ++label) {
          ASSERT_EQ(num_parts(geometry, found.labels, label), 1);
        }
        EXPECT_GT(found.num_moves, 0U);
      }
    }
  }
}

TEST(Supercells, WithBothSidesCountedNoMoveRaisesTheEnergy) {
  // [sogm] Eq. (7): then each accepted move lowers H, so more passes never end higher.
  for (const Form form : {Form{true, false}, Form{false, true}}) {
    double before = 1e300;
    for (const int passes : {1, 2, 5, 20}) {
      const auto found = extract_supercells(random_stack(cells_of(40, 24), 2, 4),
                                            {.num_levels = 1,
                                             .total = form.total,
                                             .cell_weighted = form.cell_weighted,
                                             .max_passes = passes})
                             .value();
      EXPECT_LE(found.energy, before);
      EXPECT_LT(found.energy, found.first_energy);
      before = found.energy;
    }
  }
}

TEST(Supercells, CountedByCellsAnOddCellIsLeftAlone) {
  // 8 x 2 cells, squares of 2 x 2, K = 2, one odd cell in the second square; bin centres are 1/2
  // apart. By D' the odd cell goes where it is outnumbered most: from 3/64 of its square to 4/100
  // of the next. n^(3/4) sqrt(D') would rise by that, from 0.612 to 0.669; instead the others go:
  // 0.612, 0.537, 0.420 and 0. (D' would rise first: 3/64, 2/36, 1/16.)
  const GridStack stack = stack_from(cells_of(8, 2), 1, [](int /*layer*/, Cell cell) {
    return cell == Cell{3, 1} ? 0.9 : 0.1;
  });
  SupercellOptions options{.num_levels = 1, .num_bins = 2, .contour_weight = 0.0, .total = true};
  const auto mixed = extract_supercells(stack, options).value();
  EXPECT_DOUBLE_EQ(mixed.energy, (4.0 / 25.0) / 4.0);
  EXPECT_EQ(std::ranges::count(mixed.labels, mixed.labels[11]), 5);
  options.total = false;
  options.cell_weighted = true;
  const auto apart = extract_supercells(stack, options).value();
  EXPECT_DOUBLE_EQ(apart.first_energy, std::pow(4.0, 0.75) * std::sqrt(3.0 / 64.0));
  EXPECT_EQ(apart.energy, 0.0);
  EXPECT_EQ(apart.num_moves, 3U);
  EXPECT_EQ(std::ranges::count(apart.labels, apart.labels[11]), 1);
}

TEST(Supercells, ALargerContourWeightGivesSmootherOutlines) {
  const auto num_edges = [](double weight) {
    const auto found =
        extract_supercells(objects_stack(0.2), {.num_levels = 3, .contour_weight = weight}).value();
    int edges = 0;
    for (int row = 0; row < 33; ++row) {
      for (int col = 1; col < 48; ++col) {
        const std::size_t i = found.geometry.index({col, row});
        edges += found.labels[i] != found.labels[i - 1] ? 1 : 0;
      }
    }
    return edges;
  };
  EXPECT_LT(num_edges(0.001), num_edges(0.0));
}

TEST(Supercells, AreTheSameEachTime) {
  const GridStack stack = random_stack(cells_of(50, 30), 3, 6);
  EXPECT_EQ(extract_supercells(stack).value(), extract_supercells(stack).value());
}

TEST(Supercells, AStackSmallerThanASquareIsOneSupercell) {
  for (const auto& [cols, rows] : {std::pair{1, 1}, {7, 7}, {15, 3}}) {
    const auto found =
        extract_supercells(random_stack(cells_of(cols, rows), 2, 1), {.num_levels = 4}).value();
    EXPECT_EQ(found.count, 1);
    EXPECT_EQ(found.num_moves, 0U);
    EXPECT_EQ(found.energy, found.first_energy);
  }
}

TEST(Supercells, NothingMovesWhereAllIsAlike) {
  const GridStack stack =
      stack_from(cells_of(20, 20), 2, [](int /*layer*/, Cell /*cell*/) { return 0.7; });
  const auto found = extract_supercells(stack, {.num_levels = 2, .contour_weight = 0.0}).value();
  EXPECT_EQ(found.num_moves, 0U);
  EXPECT_EQ(found.energy, 0.0);
}

TEST(Supercells, APointIsInTheSupercellOfItsCell) {
  const auto found =
      extract_supercells(random_stack(cells_of(8, 4), 1, 1), {.num_levels = 2}).value();
  EXPECT_EQ(supercell_at(found, {0.75, 0.05}), found.labels[7]);
  EXPECT_EQ(supercell_at(found, {0.81, 0.05}), std::nullopt);
  EXPECT_EQ(supercell_at(found, {std::nan(""), 0.05}), std::nullopt);
}

TEST(Supercells, WhatCannotBeDoneIsSaid) {
  const GridStack empty = GridStack::create(cells_of(2, 2)).value();
  EXPECT_EQ(extract_supercells(empty).error().field, "stack");
  const auto field_of = [](const SupercellOptions& options) {
    const auto failed = validate(options);
    return failed ? std::string() : failed.error().field;
  };
  EXPECT_EQ(field_of({.num_levels = 0}), "num_levels");
  EXPECT_EQ(field_of({.num_levels = 11}), "num_levels");
  EXPECT_EQ(field_of({.num_bins = 1}), "num_bins");
  EXPECT_EQ(field_of({.num_bins = 257}), "num_bins");
  EXPECT_EQ(field_of({.contour_weight = std::nan("")}), "contour_weight");
  EXPECT_EQ(field_of({.max_passes = 0}), "max_passes");
  EXPECT_EQ(field_of({.total = true, .cell_weighted = true}), "total");
  EXPECT_EQ(field_of({}), "");
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "supercells/binned_cells.hpp"

#include "stack_builders.hpp"

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace hypermap {
namespace {

using test::cells_of;
using test::random_stack;
using test::stack_from;
using testing::ElementsAre;

CellSums all_of(const BinnedCells& cells) {
  CellSums set(1, cells.num_layers);
  const auto count = static_cast<std::size_t>(cells.cols) * static_cast<std::size_t>(cells.rows);
  for (std::size_t i = 0; i < count; ++i) set.add_cell(0, cells.of_cell(i));
  return set;
}

GridStack row_of(const std::vector<double>& p) {
  return stack_from(cells_of(static_cast<int>(p.size()), 1), 1, [&](int /*layer*/, Cell cell) {
    return p[static_cast<std::size_t>(cell.col)];
  });
}

TEST(BinnedCells, ZeroAHalfAndOneHaveABin) {
  // [sogm] Eq. (9), with K times instead of by K: bins [k/K, (k+1)/K), the last one closed.
  const GridStack stack = row_of({0.0, 0.2, 0.3, 0.5, 0.7, 0.76, 1.0});
  EXPECT_THAT(binned(stack, 2).values, ElementsAre(1, 1, 1, 3, 3, 3, 3));
  EXPECT_THAT(binned(stack, 4).values, ElementsAre(1, 1, 3, 5, 5, 7, 7));
}

TEST(BinnedCells, AHandWorkedVariance) {
  // [sogm] Eq. (10) with one layer, K = 2: p = 0.1, 0.1, 0.6 lie at bin centres 0.25, 0.25, 0.75.
  // Mean 5/12, mean of squares 11/48: 11/48 - 25/144 = 8/144.
  const BinnedCells cells = binned(row_of({0.1, 0.1, 0.6}), 2);
  EXPECT_NEAR(variance_of(all_of(cells).of(0), 2), 8.0 / 144.0, 1e-15);
}

/// D' by the letter: the covariance matrix of the joint histogram of Eq. (9), its eigenvalues.
double sum_of_eigenvalues(const BinnedCells& cells) {
  std::map<std::vector<std::uint16_t>, double> joint;
  const auto count = static_cast<std::size_t>(cells.cols) * static_cast<std::size_t>(cells.rows);
  for (std::size_t i = 0; i < count; ++i) {
    const auto values = cells.of_cell(i);
    joint[{values.begin(), values.end()}] += 1.0 / static_cast<double>(count);
  }
  const auto centre = [&](const std::vector<std::uint16_t>& bin) {
    Eigen::VectorXd point(cells.num_layers);
    for (int n = 0; n < cells.num_layers; ++n) {
      point[n] = bin[static_cast<std::size_t>(n)] / (2.0 * cells.num_bins);
    }
    return point;
  };
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(cells.num_layers);
  for (const auto& [bin, share] : joint) mean += share * centre(bin);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(cells.num_layers, cells.num_layers);
  for (const auto& [bin, share] : joint) {
    covariance += share * (centre(bin) - mean) * (centre(bin) - mean).transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).eigenvalues().sum();
}

TEST(BinnedCells, MarginalVariancesAreTheEigenvaluesOfTheJointHistogram) {
  // [sogm] Eq. (8) to (10): the sum of the eigenvalues is the trace.
  for (const int num_layers : {1, 2, 3, 5}) {
    for (const int num_bins : {2, 7, 16, 256}) {
      const auto seed =
          10U * static_cast<std::uint64_t>(num_layers) + static_cast<std::uint64_t>(num_bins);
      const BinnedCells cells = binned(random_stack(cells_of(9, 5), num_layers, seed), num_bins);
      EXPECT_NEAR(variance_of(all_of(cells).of(0), num_bins), sum_of_eigenvalues(cells), 1e-12);
    }
  }
}

TEST(BinnedCells, CellsCanBeAddedAndTakenAway) {
  const BinnedCells cells = binned(random_stack(cells_of(6, 4), 3, 1), 16);
  CellSums first = all_of(cells);
  CellSums part(1, 3);
  for (const std::size_t i : {2U, 5U, 11U}) part.add_cell(0, cells.of_cell(i));
  const CellSums before = first;
  const double without = variance_with(first.of(0), part.of(0), -1, 16);
  first.remove(0, part.of(0));
  EXPECT_EQ(first.num_cells(0), 21);
  EXPECT_DOUBLE_EQ(variance_of(first.of(0), 16), without);
  EXPECT_DOUBLE_EQ(variance_with(first.of(0), part.of(0), 1, 16), variance_of(before.of(0), 16));
  first.add(0, part.of(0));
  EXPECT_TRUE(std::ranges::equal(first.of(0), before.of(0)));
  first.clear(0);
  EXPECT_TRUE(std::ranges::equal(first.of(0), CellSums(1, 3).of(0)));
}

TEST(BinnedCells, NoVarianceIsToldExactly) {
  EXPECT_TRUE(has_no_variance(all_of(binned(row_of({0.51, 0.55, 0.5}), 4)).of(0)));
  EXPECT_FALSE(has_no_variance(all_of(binned(row_of({0.51, 0.55, 0.76}), 4)).of(0)));
  // Mean 3 of values 1, 5: a sum that divides does not suffice.
  EXPECT_FALSE(has_no_variance(all_of(binned(row_of({0.1, 0.6}), 4)).of(0)));
  EXPECT_TRUE(has_no_variance(all_of(binned(row_of({0.5}), 2)).of(0)));
}

}  // namespace
}  // namespace hypermap

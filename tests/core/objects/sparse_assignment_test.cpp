// SPDX-License-Identifier: BSD-3-Clause
#include "objects/association/sparse_assignment.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/objects/assignment.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace hypermap {
namespace {

double sum_of(const std::vector<IndexPair>& pairs, const Eigen::MatrixXd& costs) {
  double sum = 0.0;
  for (const IndexPair& pair : pairs) {
    sum += costs(static_cast<Eigen::Index>(pair.row), static_cast<Eigen::Index>(pair.column));
  }
  return sum;
}

TEST(SparseAssignment, IsAsGoodAsTheWholeMatrix) {
  CounterRng random(5, 1);
  for (int round = 0; round < 200; ++round) {
    Eigen::MatrixXd costs = Eigen::MatrixXd::Constant(9, 7, kForbiddenPair);
    std::vector<CostedPair> candidates;
    for (std::size_t row = 0; row < 9; ++row) {
      for (std::size_t column = 0; column < 7; ++column) {
        if (!random.chance(0.2)) continue;
        const double cost = random.uniform(0.0, 1.0);
        costs(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = cost;
        candidates.push_back({{row, column}, cost});
      }
    }
    std::vector<IndexPair> expected;
    const auto whole = assign(costs);
    for (std::size_t row = 0; row < whole.size(); ++row) {
      if (whole[row]) expected.push_back({row, *whole[row]});
    }
    const auto found = assign_sparse(candidates);
    EXPECT_EQ(found.size(), expected.size());
    EXPECT_NEAR(sum_of(found, costs), sum_of(expected, costs), 1e-9);
    std::set<std::size_t> rows;
    std::set<std::size_t> columns;
    for (const IndexPair& pair : found) {
      EXPECT_TRUE(rows.insert(pair.row).second);
      EXPECT_TRUE(columns.insert(pair.column).second);
    }
  }
}

TEST(SparseAssignment, NoPairsGiveNone) {
  EXPECT_TRUE(assign_sparse({}).empty());
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace hypermap {
namespace {

struct Quality {
  std::size_t pairs = 0;
  double cost = 0.0;
};

Quality quality_of(const Eigen::MatrixXd& costs, const std::vector<std::optional<std::size_t>>& a) {
  Quality q;
  std::vector<bool> taken(static_cast<std::size_t>(costs.cols()), false);
  for (std::size_t row = 0; row < a.size(); ++row) {
    if (!a[row]) continue;
    EXPECT_FALSE(taken[*a[row]]);
    taken[*a[row]] = true;
    const double cost = costs(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(*a[row]));
    EXPECT_TRUE(std::isfinite(cost));
    ++q.pairs;
    q.cost += cost;
  }
  return q;
}

/// Every way of giving rows to columns, "none" included, by permuting a padded square.
Quality best_by_trying_all(const Eigen::MatrixXd& costs) {
  const auto rows = static_cast<std::size_t>(costs.rows());
  const auto columns = static_cast<std::size_t>(costs.cols());
  std::vector<std::size_t> order(std::max(rows, columns));
  std::iota(order.begin(), order.end(), 0U);
  Quality best{0, 0.0};
  do {
    Quality q;
    for (std::size_t row = 0; row < rows; ++row) {
      if (order[row] >= columns) continue;
      const double c = costs(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(order[row]));
      if (!std::isfinite(c)) continue;
      ++q.pairs;
      q.cost += c;
    }
    if (q.pairs > best.pairs || (q.pairs == best.pairs && q.cost < best.cost)) best = q;
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

TEST(Assignment, ByHand) {
  // The cheapest single pair (0, 0) at 1 would leave 9 for the other: 10. Crossed: 2 + 3 = 5.
  Eigen::MatrixXd costs(2, 2);
  costs << 1, 2, 3, 9;
  EXPECT_EQ(assign(costs), (std::vector<std::optional<std::size_t>>{1, 0}));
}

TEST(Assignment, AgreesWithTryingAll) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> cost(-1.0, 1.0);
  for (int round = 0; round < 600; ++round) {
    Eigen::MatrixXd costs(1 + static_cast<Eigen::Index>(random() % 6),
                          1 + static_cast<Eigen::Index>(random() % 6));
    for (Eigen::Index i = 0; i < costs.size(); ++i) {
      costs.data()[i] = random() % 3 == 0 ? kForbiddenPair : cost(random);
    }
    const Quality found = quality_of(costs, assign(costs));
    const Quality best = best_by_trying_all(costs);
    ASSERT_EQ(found.pairs, best.pairs) << costs;
    ASSERT_NEAR(found.cost, best.cost, 1e-9) << costs;
  }
}

TEST(Assignment, WithoutRowsOrColumnsThereAreNoPairs) {
  EXPECT_TRUE(assign(Eigen::MatrixXd(0, 3)).empty());
  EXPECT_EQ(assign(Eigen::MatrixXd(2, 0)), (std::vector<std::optional<std::size_t>>(2)));
}

TEST(Assignment, ForbiddenAndNanPairsAreNotMade) {
  Eigen::MatrixXd costs(2, 2);
  costs << kForbiddenPair, static_cast<double>(NAN), 1.0, kForbiddenPair;
  EXPECT_EQ(assign(costs), (std::vector<std::optional<std::size_t>>{std::nullopt, 0}));
}

TEST(Assignment, ThreeHundredAreQuick) {
  std::mt19937 random(8);
  Eigen::MatrixXd costs(300, 300);
  for (Eigen::Index i = 0; i < costs.size(); ++i) {
    costs.data()[i] = static_cast<double>(random() % 1000);
  }
  EXPECT_EQ(quality_of(costs, assign(costs)).pairs, 300U);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/wilcoxon.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hypermap {
namespace {

WilcoxonResult test_of(const std::vector<double>& a, const std::vector<double>& b) {
  return wilcoxon_one_sided(a, b).value();
}

TEST(Wilcoxon, FiveOutOfFiveHaveOneChanceInThirtyTwo) {
  // All five differences are positive: W+ = 15, only 1 of 2^5 sign patterns reaches it: 0.03125.
  // The thesis' cups ([hypermap] table 4) show this very p of 0.031.
  const auto result = test_of({2, 3, 4, 5, 6}, {1, 1, 1, 1, 1});
  EXPECT_EQ(result.n, 5U);
  EXPECT_DOUBLE_EQ(result.rank_sum, 15.0);
  EXPECT_DOUBLE_EQ(result.p, 1.0 / 32.0);
  EXPECT_TRUE(result.exact);
}

TEST(Wilcoxon, ThreeOutOfThreeHaveOneChanceInEight) {
  // [hypermap] table 4, tvmonitor: three monitors and p = 0.13 (0.125).
  EXPECT_DOUBLE_EQ(test_of({0.5, 0.6, 0.7}, {0.1, 0.1, 0.1}).p, 0.125);
}

TEST(Wilcoxon, CountsPatternsWithMixedSigns) {
  // Differences +1, -2, +3: W+ = 4. Patterns with W+ >= 4: {1,3} 4, {2,3} 5, {1,2,3} 6: 3 of 8.
  EXPECT_DOUBLE_EQ(test_of({1, 0, 3}, {0, 2, 0}).p, 3.0 / 8.0);
}

TEST(Wilcoxon, TiedDifferencesShareTheirRank) {
  // Differences +1, +1, -1: all of rank 2, W+ = 4. Patterns with W+ >= 4: two or three positive,
  // 4 of 8.
  const auto result = test_of({1, 1, 0}, {0, 0, 1});
  EXPECT_DOUBLE_EQ(result.rank_sum, 4.0);
  EXPECT_DOUBLE_EQ(result.p, 0.5);
}

TEST(Wilcoxon, EqualPairsSayNothing) {
  const auto result = test_of({1, 2}, {1, 2});
  EXPECT_EQ(result.n, 0U);
  EXPECT_DOUBLE_EQ(result.p, 1.0);
}

TEST(Wilcoxon, TheApproximationContinuesTheExactDistribution) {
  // At 30 pairs the exact p is taken, at 31 the normal one; a pair with the largest rank and a
  // balanced history hardly moves it.
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.3, 1.0);
  std::vector<double> a(30);
  for (double& value : a) value = noise(random);
  const auto exact = test_of(a, std::vector<double>(30, 0.0));
  a.push_back(0.001);
  const auto normal = test_of(a, std::vector<double>(31, 0.0));
  EXPECT_TRUE(exact.exact);
  EXPECT_FALSE(normal.exact);
  EXPECT_NEAR(normal.p, exact.p, 0.02);
}

TEST(Wilcoxon, RefusesUnpairedAndUnboundedSamples) {
  const std::vector<double> one{1.0};
  const std::vector<double> two{1.0, 2.0};
  const std::vector<double> bad{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FALSE(wilcoxon_one_sided(one, two));
  EXPECT_FALSE(wilcoxon_one_sided(one, bad));
}

}  // namespace
}  // namespace hypermap

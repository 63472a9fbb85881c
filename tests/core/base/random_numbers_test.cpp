// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/random_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hypermap {
namespace {

TEST(CounterRng, MixingIsThatOfSplitmix64) {
  // First outputs of the reference generator with state 0: its n-th state is n times the golden
  // increment, so mix_bits(0) and mix_bits(0x9E3779B97F4A7C15) are outputs one and two.
  EXPECT_EQ(mix_bits(0), 0xE220A8397B1DCDAFU);
  EXPECT_EQ(mix_bits(0x9E3779B97F4A7C15U), 0x6E789E6AA1B965F4U);
  SplitMix64 generator;
  EXPECT_EQ(generator(), 0xE220A8397B1DCDAFU);
  EXPECT_EQ(generator(), 0x6E789E6AA1B965F4U);
}

TEST(CounterRng, TheQuantileInvertsTheNormalDistribution) {
  for (const double x : {-8.0, -5.5, -3.0, -1.3, -0.2, 0.0, 0.4, 1.0, 1.4, 2.5, 6.0}) {
    const double p = 0.5 * std::erfc(-x / std::sqrt(2.0));
    EXPECT_NEAR(normal_quantile(p), x, x > 5.0 ? 1e-7 : 1e-12)
        << x;  // p near 1 has few digits left
  }
}

TEST(CounterRng, TheQuantileHasTheTextbookValues) {
  EXPECT_DOUBLE_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.001), -3.090232306167813, 1e-13);
}

TEST(CounterRng, NumbersDependOnNameAndPositionOnly) {
  const CounterRng stream(7, 1, 2, 3);
  CounterRng drawn = stream;
  for (std::uint64_t i = 0; i < 10; ++i) EXPECT_EQ(drawn.uniform(), stream.uniform_at(i));
  EXPECT_EQ(CounterRng(7, 1, 2, 3).bits_at(99), stream.bits_at(99));
}

TEST(CounterRng, EachPartOfTheNameMakesAnotherStream) {
  const std::vector<CounterRng> streams{CounterRng(7, 1, 2, 3),
                                        CounterRng(8, 1, 2, 3),
                                        CounterRng(7, 2, 2, 3),
                                        CounterRng(7, 2, 1, 3),
                                        CounterRng(7, 1, 3, 2),
                                        CounterRng(7, 1, 2, 4)};
  for (std::size_t i = 0; i < streams.size(); ++i) {
    for (std::size_t j = i + 1; j < streams.size(); ++j)
      EXPECT_NE(streams[i].bits_at(0), streams[j].bits_at(0)) << i << " " << j;
  }
}

TEST(CounterRng, UniformNumbersFillTheOpenInterval) {
  CounterRng random(1, 2);
  constexpr int kDraws = 100'000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
  }
  // Mean 1/2 with standard error sqrt(1/12/n) = 0.0009; mean square 1/3 with sqrt(4/45/n) = 0.0009.
  EXPECT_NEAR(sum / kDraws, 0.5, 0.004);
  EXPECT_NEAR(squares / kDraws, 1.0 / 3.0, 0.004);
}

TEST(CounterRng, NormalNumbersHaveTheRightMoments) {
  CounterRng random(5, 6);
  constexpr int kDraws = 100'000;
  double sum = 0.0;
  double squares = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    beyond_two += std::abs(x) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 4.0 / std::sqrt(kDraws));
  EXPECT_NEAR(squares / kDraws, 1.0, 4.0 * std::sqrt(2.0 / kDraws));
  // P(|x| > 2) = 0.0455, standard error 0.00066.
  EXPECT_NEAR(static_cast<double>(beyond_two) / kDraws, 0.0455, 0.0027);
}

TEST(CounterRng, BelowGivesEachNumberItsShare) {
  CounterRng random(9, 1);
  std::vector<int> counts(6, 0);
  for (int i = 0; i < 60'000; ++i) ++counts.at(random.below(6));
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 4 * 92);  // sqrt(60000 5/36) = 91.3
  EXPECT_EQ(random.below(1), 0U);
}

TEST(CounterRng, ChanceIsNeverAtZeroAndAlwaysAtOne) {
  CounterRng random(2, 2);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(random.chance(0.0));
    EXPECT_TRUE(random.chance(1.0));
  }
}

}  // namespace
}  // namespace hypermap

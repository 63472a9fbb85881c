// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/series_sample.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

TEST(SeriesSample, OfAFewValuesItIsTheirNumbers) {
  SeriesSample sample;
  EXPECT_EQ(sample.numbers(), FiveNumbers{});
  for (const double value : {4.0, 1.0, 3.0, 2.0, 5.0}) sample.add(value);
  EXPECT_EQ(sample.numbers(),
            (FiveNumbers{.min = 1.0, .lower = 2.0, .median = 3.0, .upper = 4.0, .max = 5.0}));
  EXPECT_EQ(sample.n(), 5U);
  EXPECT_EQ(sample.stride(), 1U);
}

TEST(SeriesSample, NegativeValuesHaveANegativeMaximum) {
  SeriesSample sample;
  sample.add(-2.0);
  sample.add(-1.0);
  EXPECT_EQ(sample.numbers().max, -1.0);
  EXPECT_EQ(sample.numbers().min, -2.0);
}

/// The numbers of every `stride`-th of 0 .. n - 1, ends of all.
FiveNumbers numbers_of_every(std::size_t n, std::size_t stride) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < n; i += stride) kept.push_back(static_cast<double>(i));
  FiveNumbers numbers = five_numbers(kept);
  numbers.max = static_cast<double>(n - 1);
  return numbers;
}

TEST(SeriesSample, KeepsEveryKthOfALongSeries) {
  SeriesSample sample;
  const std::size_t whole = SeriesSample::kCapacity;
  std::size_t n = 0;
  for (const std::size_t end : {whole, whole + 1, 2 * whole, 2 * whole + 1, 5 * whole + 77}) {
    for (; n < end; ++n) sample.add(static_cast<double>(n));
    const std::size_t stride = end <= whole ? 1 : end <= 2 * whole ? 2 : end <= 4 * whole ? 4 : 8;
    EXPECT_EQ(sample.stride(), stride) << end;
    EXPECT_EQ(sample.numbers(), numbers_of_every(end, stride)) << end;
    EXPECT_EQ(sample.n(), end);
  }
}

}  // namespace
}  // namespace hypermap

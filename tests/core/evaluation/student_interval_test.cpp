// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/student_interval.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hypermap {
namespace {

// With one degree of freedom Student's distribution is Cauchy's: t = tan(0.475 pi) = 12.7062.
TEST(StudentInterval, OfTwoValues) {
  // 0.5 and 1: s = 0.25 sqrt 2, s / sqrt 2 = 0.25.
  EXPECT_NEAR(student_half_width_95(std::sqrt(0.125), 2).value(), 3.17655, 1e-5);
}

// Two degrees have a closed form: t = x sqrt(2 / (1 - x^2)) of x = 0.95, 4.30265.
TEST(StudentInterval, OfThreeValues) {
  EXPECT_NEAR(student_half_width_95(std::sqrt(3.0), 3).value(), 4.30265, 1e-5);
}

// The tables of the distribution: 2.262 of nine degrees, 1.984 of ninety-nine.
TEST(StudentInterval, OfMoreValues) {
  EXPECT_NEAR(student_half_width_95(std::sqrt(10.0), 10).value(), 2.262, 5e-4);
  EXPECT_NEAR(student_half_width_95(10.0, 100).value(), 1.984, 5e-4);
}

TEST(StudentInterval, EqualValuesHaveNoWidth) {
  EXPECT_EQ(student_half_width_95(0.0, 5), 0.0);
}

TEST(StudentInterval, OfFewerThanTwoValuesAndOfNoDeviationThereIsNone) {
  EXPECT_FALSE(student_half_width_95(1.0, 0));
  EXPECT_FALSE(student_half_width_95(1.0, 1));
  EXPECT_FALSE(student_half_width_95(-1.0, 2));
  EXPECT_FALSE(student_half_width_95(std::numeric_limits<double>::quiet_NaN(), 2));
  EXPECT_FALSE(student_half_width_95(std::numeric_limits<double>::infinity(), 2));
}

}  // namespace
}  // namespace hypermap

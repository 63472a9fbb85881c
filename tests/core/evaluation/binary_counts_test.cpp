// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/binary_counts.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

// [smap] Eq. (B.1) to (B.4): of 8 things 6 are found; of 5 candidates that are none 4 are rejected.
TEST(BinaryCounts, RatesByHand) {
  const BinaryCounts counts{
      .true_positives = 6, .false_positives = 1, .false_negatives = 2, .true_negatives = 4};
  EXPECT_DOUBLE_EQ(counts.true_positive_rate().value(), 0.75);
  EXPECT_DOUBLE_EQ(counts.true_negative_rate().value(), 0.8);
  EXPECT_DOUBLE_EQ(counts.false_positive_rate().value(), 0.2);
  EXPECT_DOUBLE_EQ(counts.false_negative_rate().value(), 0.25);
}

// [smap] Eq. (B.5): 10 of 13 decisions are right.
TEST(BinaryCounts, AccuracyByHand) {
  const BinaryCounts counts{
      .true_positives = 6, .false_positives = 1, .false_negatives = 2, .true_negatives = 4};
  EXPECT_DOUBLE_EQ(counts.accuracy().value(), 10.0 / 13.0);
}

// [smap] Eq. (B.6), table 5.1: 15 chairs and 11 that are none, 57.7 %.
TEST(BinaryCounts, PrecisionOfTheChairsOfTheText) {
  const BinaryCounts chairs{.true_positives = 15, .false_positives = 11};
  EXPECT_NEAR(chairs.precision().value(), 0.577, 5e-4);
}

// Precision 15/26 and recall 15/19 of 19 chairs: F1 = 30/45.
TEST(BinaryCounts, F1IsTheHarmonicMeanOfPrecisionAndRecall) {
  const BinaryCounts chairs{.true_positives = 15, .false_positives = 11, .false_negatives = 4};
  EXPECT_DOUBLE_EQ(chairs.f1().value(), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(BinaryCounts{.false_positives = 1}.f1().value(), 0.0);
}

TEST(BinaryCounts, WhatWouldDivideByZeroIsNone) {
  const BinaryCounts nothing;
  EXPECT_FALSE(nothing.true_positive_rate());
  EXPECT_FALSE(nothing.true_negative_rate());
  EXPECT_FALSE(nothing.false_positive_rate());
  EXPECT_FALSE(nothing.false_negative_rate());
  EXPECT_FALSE(nothing.accuracy());
  EXPECT_FALSE(nothing.precision());
  EXPECT_FALSE(nothing.f1());
}

TEST(BinaryCounts, RatesThatNeedUncountedNegativesAreNone) {
  const BinaryCounts counts{.true_positives = 6,
                            .false_positives = 1,
                            .false_negatives = 2,
                            .true_negatives = std::nullopt};
  EXPECT_FALSE(counts.true_negative_rate());
  EXPECT_FALSE(counts.false_positive_rate());
  EXPECT_FALSE(counts.accuracy());
  EXPECT_TRUE(counts.true_positive_rate());
  EXPECT_TRUE(counts.precision());
}

TEST(BinaryCounts, ASumKnowsItsNegativesWhenBothDo) {
  BinaryCounts sum{
      .true_positives = 1, .false_positives = 2, .false_negatives = 3, .true_negatives = 4};
  sum += sum;
  EXPECT_EQ(
      sum,
      (BinaryCounts{
          .true_positives = 2, .false_positives = 4, .false_negatives = 6, .true_negatives = 8}));
  BinaryCounts unknown{.true_negatives = std::nullopt};
  sum += unknown;
  EXPECT_FALSE(sum.true_negatives);
  unknown += BinaryCounts{.true_positives = 1, .true_negatives = 1};
  EXPECT_FALSE(unknown.true_negatives);
  EXPECT_EQ(unknown.true_positives, 1U);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/visibility_histogram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(VisibilityHistogram, NearObservationsCountMore) {
  // [smap] Eq. (3.12): 2 / (1 + 0/2) = 2, 2 / (1 + 2/2) = 1, 2 / (1 + 6/2) = 0.5.
  const VisibilityHistogramOptions options;
  EXPECT_DOUBLE_EQ(histogram_increment(options, 0.0).value(), 2.0);
  EXPECT_DOUBLE_EQ(histogram_increment(options, 2.0).value(), 1.0);
  EXPECT_DOUBLE_EQ(histogram_increment(options, 6.0).value(), 0.5);
}

TEST(VisibilityHistogram, AnObservationIsSpreadOverFiveBins) {
  // [smap] Eq. (3.13) at 2 m, bin 0: shares 0.5, 1.5, 6, 1.5, 0.5 of 10, times 1; circular.
  VisibilityHistogram histogram;
  histogram.observe(10.0 * kDegree, 2.0);
  EXPECT_NEAR(histogram.bins()[16].value(), 0.05, 1e-12);
  EXPECT_NEAR(histogram.bins()[17].value(), 0.15, 1e-12);
  EXPECT_NEAR(histogram.bins()[0].value(), 0.6, 1e-12);
  EXPECT_NEAR(histogram.bins()[1].value(), 0.15, 1e-12);
  EXPECT_NEAR(histogram.bins()[2].value(), 0.05, 1e-12);
  EXPECT_DOUBLE_EQ(histogram.bins()[3].value(), 0.0);
}

TEST(VisibilityHistogram, ANegativeObservationTakesTheSameAway) {
  VisibilityHistogram histogram;
  histogram.observe(1.0, 1.5);
  histogram.weaken(1.0, 1.5);
  for (const LogOdds bin : histogram.bins()) EXPECT_NEAR(bin.value(), 0.0, 1e-12);
  histogram.weaken(1.0, 0.0, 0.5);
  EXPECT_NEAR(histogram.bins()[histogram.bin_of(1.0)].value(), -0.6, 1e-12);
}

TEST(VisibilityHistogram, BinsStopAtTheBounds) {
  VisibilityHistogram histogram;
  for (int i = 0; i < 100; ++i) histogram.observe(0.0, 0.0);
  EXPECT_DOUBLE_EQ(histogram.bins()[0].value(), 10.0);
  for (int i = 0; i < 200; ++i) histogram.weaken(0.0, 0.0);
  EXPECT_DOUBLE_EQ(histogram.bins()[0].value(), -10.0);
}

TEST(VisibilityHistogram, BearingsFallIntoTheirBins) {
  const VisibilityHistogram histogram;
  EXPECT_EQ(histogram.bin_of(0.0), 0U);
  EXPECT_EQ(histogram.bin_of(19.9 * kDegree), 0U);
  EXPECT_EQ(histogram.bin_of(20.1 * kDegree), 1U);
  EXPECT_EQ(histogram.bin_of(-0.1 * kDegree), 17U);
  EXPECT_EQ(histogram.bin_of(-1e-18), 17U);
  EXPECT_EQ(histogram.bin_of(10.0 * kDegree + 6.0 * std::numbers::pi), 0U);
}

TEST(VisibilityHistogram, ConfidenceIsTheShareOfBinsThatSayVisible) {
  // [smap] Eq. (3.26), table D.2: p > 0.7 is l > 0.847, p < 0.4 is l < -0.405. Two bins say
  // visible, one says not, the rest nothing: 2/3.
  std::vector<LogOdds> bins(18);
  bins[0] = LogOdds(0.85);
  bins[1] = LogOdds(5.0);
  bins[2] = LogOdds(0.84);
  bins[3] = LogOdds(-0.41);
  bins[4] = LogOdds(-0.40);
  const VisibilityHistogramOptions counted{.confidence = HistogramConfidence::kCounted};
  EXPECT_NEAR(VisibilityHistogram::from_bins(counted, bins).value().confidence(), 2.0 / 3.0, 1e-12);
  EXPECT_DOUBLE_EQ(VisibilityHistogram(counted).confidence(), 0.0);
}

TEST(VisibilityHistogram, ConfidenceIsTheShareOfTheEvidenceThatSpeaksForIt) {
  // Three for, one against: 3 / 4. What was never looked at, [smap] 3.5.2, speaks neither way.
  std::vector<LogOdds> bins(18);
  bins[0] = LogOdds(2.5);
  bins[9] = LogOdds(0.5);
  bins[17] = LogOdds(-1.0);
  EXPECT_NEAR(VisibilityHistogram::from_bins({}, bins).value().confidence(), 0.75, 1e-12);
  bins[17] = LogOdds();
  EXPECT_DOUBLE_EQ(VisibilityHistogram::from_bins({}, bins).value().confidence(), 1.0);
  EXPECT_DOUBLE_EQ(VisibilityHistogram().confidence(), 1.0);
  // Continuous: a bin on either side of 0 changes little, where (3.26) jumps at its thresholds.
  bins[5] = LogOdds(-1e-6);
  EXPECT_NEAR(VisibilityHistogram::from_bins({}, bins).value().confidence(), 1.0, 1e-6);
}

TEST(VisibilityHistogram, AnglesDifferByAtMostHalfATurn) {
  // [smap] Eq. (3.22): atan2(sin, cos) lies in (-pi, pi], not in ]-pi/2, pi/2] as printed.
  EXPECT_NEAR(angle_difference_rad(3.0, -3.0), 6.0 - 2.0 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(angle_difference_rad(100.0 * kDegree, -20.0 * kDegree), 120.0 * kDegree, 1e-12);
  EXPECT_GT(angle_difference_rad(100.0 * kDegree, -20.0 * kDegree), std::numbers::pi / 2.0);
}

TEST(VisibilityHistogram, WhatIsStoredComesBack) {
  VisibilityHistogram histogram;
  histogram.observe(2.0, 1.0);
  const std::vector<LogOdds> bins(histogram.bins().begin(), histogram.bins().end());
  EXPECT_EQ(VisibilityHistogram::from_bins({}, bins).value(), histogram);
  EXPECT_FALSE(VisibilityHistogram::from_bins({}, std::vector<LogOdds>(17)).has_value());
  EXPECT_FALSE(
      VisibilityHistogram::from_bins({}, std::vector<LogOdds>(18, LogOdds(11))).has_value());
}

TEST(VisibilityHistogram, BadOptionsAreNamed) {
  EXPECT_EQ(validate(VisibilityHistogramOptions{.num_bins = 3}).error().field, "num_bins");
  EXPECT_EQ(validate(VisibilityHistogramOptions{.weights = {0, 0, 0, 0, 0}}).error().field,
            "weights");
  EXPECT_EQ(validate(VisibilityHistogramOptions{.hidden_below = 0.8}).error().field,
            "hidden_below");
  EXPECT_EQ(validate(VisibilityHistogramOptions{.base_increment = static_cast<double>(NAN)})
                .error()
                .field,
            "base_increment");
  EXPECT_TRUE(validate(VisibilityHistogramOptions{}).has_value());
}

}  // namespace
}  // namespace hypermap

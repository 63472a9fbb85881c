// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/calibration.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

TEST(Calibration, ByHand) {
  // Two bins: 0.2 and 0.4, one of two true; 0.8 and 0.9, both true. Errors |0.3 - 0.5| = 0.2 and
  // |0.85 - 1| = 0.15, their mean 0.175.
  const std::vector<Prediction> predictions{{0.9, true}, {0.2, false}, {0.8, true}, {0.4, true}};
  const CalibrationReport report = calibration(predictions, {.num_bins = 2});
  EXPECT_EQ(report.n, 4U);
  ASSERT_EQ(report.bins.size(), 2U);
  EXPECT_EQ(report.bins[0].n, 2U);
  EXPECT_DOUBLE_EQ(report.bins[0].mean_probability, 0.3);
  EXPECT_DOUBLE_EQ(report.bins[0].true_share, 0.5);
  EXPECT_NEAR(*report.expected_error, 0.175, 1e-12);
  EXPECT_NEAR(*report.log_loss,
              -(std::log(0.9) + std::log(0.8) + std::log(0.8) + std::log(0.4)) / 4.0,
              1e-12);
}

TEST(Calibration, EqualProbabilitiesShareTheirOutcomesWhateverTheOrder) {
  // Six times 0.5, three of them true: in every bin half is true, so nothing is wrong.
  std::vector<Prediction> predictions;
  predictions.reserve(6);
  for (int i = 0; i < 6; ++i) predictions.push_back({0.5, i < 3});
  const CalibrationReport report = calibration(predictions, {.num_bins = 3});
  EXPECT_NEAR(*report.expected_error, 0.0, 1e-12);
  std::reverse(predictions.begin(), predictions.end());
  EXPECT_EQ(*calibration(predictions, {.num_bins = 3}).expected_error, *report.expected_error);
}

TEST(Calibration, BinsAreEquallyFilledAndNoneIsEmpty) {
  std::vector<Prediction> predictions;
  predictions.reserve(23);
  for (int i = 0; i < 23; ++i) predictions.push_back({i / 23.0, true});
  std::size_t sum = 0;
  for (const CalibrationBin& bin : calibration(predictions).bins) {
    EXPECT_TRUE(bin.n == 2 || bin.n == 3);
    sum += bin.n;
  }
  EXPECT_EQ(sum, 23U);
  EXPECT_EQ(calibration(std::vector<Prediction>{{1.0, true}}).bins.size(), 1U);
}

TEST(Calibration, TheIntervalHoldsTheErrorOfAnOverconfidentForecast) {
  // Says 0.9, right in 60 %: the error is 0.3, give or take what 500 draws leave open:
  // 1.96 sqrt(0.6 0.4 / 500) = 0.043.
  std::vector<Prediction> predictions;
  predictions.reserve(500);
  for (int i = 0; i < 500; ++i) predictions.push_back({0.9, i % 5 < 3});
  const CalibrationReport report = calibration(predictions);
  EXPECT_NEAR(*report.expected_error, 0.3, 1e-12);
  EXPECT_NEAR(report.error_low, 0.257, 0.01);
  EXPECT_NEAR(report.error_high, 0.343, 0.01);
  EXPECT_EQ(calibration(predictions).error_low, report.error_low);
}

TEST(Calibration, CertainAndWrongCostsWhatOneInAMillionDoes) {
  const auto report = calibration(std::vector<Prediction>{{1.0, false}});
  EXPECT_NEAR(*report.log_loss, 6.0 * std::log(10.0), 1e-9);
  EXPECT_EQ(*report.expected_error, 1.0);
}

TEST(Calibration, NothingSaidIsNothing) {
  const CalibrationReport report = calibration({});
  EXPECT_FALSE(report.expected_error);
  EXPECT_FALSE(report.log_loss);
  EXPECT_TRUE(report.bins.empty());
  EXPECT_EQ(validate(CalibrationOptions{.num_bins = 0}).error().field, "num_bins");
}

}  // namespace
}  // namespace hypermap

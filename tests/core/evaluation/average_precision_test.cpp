// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/average_precision.hpp"

#include "hypermap/core/base/random_numbers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Of three truths: right 0.9, wrong 0.8, right 0.7; the third is never found.
const std::array<Prediction, 3> kRightWrongRight{
    {{.probability = 0.9, .is_true = true}, {0.8, false}, {0.7, true}}};

// [smap] Eq. (B.7) and (B.8): 1/3 at precision 1, 0 at 1/2, 1/3 at 2/3: 1/3 + 2/9 = 5/9.
TEST(AveragePrecision, ByHand) {
  EXPECT_NEAR(average_precision(kRightWrongRight, 3).value(), 5.0 / 9.0, 1e-15);
  EXPECT_THAT(precision_recall(kRightWrongRight, 3),
              ElementsAre(PrecisionRecallPoint{0.9, 1.0, 1.0 / 3.0},
                          PrecisionRecallPoint{0.8, 0.5, 1.0 / 3.0},
                          PrecisionRecallPoint{0.7, 2.0 / 3.0, 2.0 / 3.0}));
}

TEST(AveragePrecision, OfTruthsAloneBeforeAllElseIsOne) {
  const std::array<Prediction, 4> ranked{{{0.9, true}, {0.8, true}, {0.5, false}, {0.4, false}}};
  EXPECT_DOUBLE_EQ(average_precision(ranked, 2).value(), 1.0);
  const std::array<Prediction, 4> reversed{{{0.1, true}, {0.2, true}, {0.5, false}, {0.4, false}}};
  // 1/2 at 1/3, 1/2 at 2/4.
  EXPECT_NEAR(average_precision(reversed, 2).value(), 0.5 / 3.0 + 0.25, 1e-15);
}

TEST(AveragePrecision, EqualProbabilitiesAreOnePoint) {
  const std::array<Prediction, 4> equal{{{0.5, true}, {0.5, false}, {0.5, false}, {0.5, true}}};
  EXPECT_THAT(precision_recall(equal, 4), ElementsAre(PrecisionRecallPoint{0.5, 0.5, 0.5}));
  EXPECT_DOUBLE_EQ(average_precision(equal, 4).value(), 0.25);
}

TEST(AveragePrecision, WithoutTruthsThereIsNoneAndWithoutObjectsNothing) {
  EXPECT_FALSE(average_precision(kRightWrongRight, 0));
  EXPECT_DOUBLE_EQ(average_precision({}, 2).value(), 0.0);
  EXPECT_THAT(precision_recall({}, 2), IsEmpty());
}

// [smap] Eq. (B.9)
TEST(AveragePrecision, MeanOverTheClassesThatHaveOne) {
  EXPECT_DOUBLE_EQ(
      mean_average_precision(std::array<std::optional<double>, 3>{0.5, std::nullopt, 1.0}).value(),
      0.75);
  EXPECT_FALSE(mean_average_precision(std::array<std::optional<double>, 1>{std::nullopt}));
  EXPECT_FALSE(mean_average_precision({}));
}

/// Straight from the definition: for each distinct probability all that is at least so probable.
double area_by_thresholds(const std::vector<Prediction>& predictions, std::size_t num_truths) {
  std::vector<double> thresholds;
  thresholds.reserve(predictions.size());
  for (const Prediction& one : predictions) thresholds.push_back(one.probability);
  std::sort(thresholds.rbegin(), thresholds.rend());
  thresholds.erase(std::unique(thresholds.begin(), thresholds.end()), thresholds.end());
  double area = 0.0;
  double recall = 0.0;
  for (const double threshold : thresholds) {
    double taken = 0.0;
    double right = 0.0;
    for (const Prediction& one : predictions) {
      if (one.probability < threshold) continue;
      taken += 1.0;
      right += one.is_true ? 1.0 : 0.0;
    }
    const double recall_here = right / static_cast<double>(num_truths);
    area += (recall_here - recall) * right / taken;
    recall = recall_here;
  }
  return area;
}

TEST(AveragePrecision, IsTheAreaOverThresholdsInAnyOrder) {
  CounterRng random(7, 0);
  const auto below = [&random](std::size_t n) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
  };
  for (int round = 0; round < 300; ++round) {
    std::vector<Prediction> predictions;
    std::size_t num_true = 0;
    const auto n = below(12);
    predictions.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
      // Few distinct values, so that many are equal.
      const double probability = static_cast<double>(below(5)) / 5.0;
      predictions.push_back({probability, random.uniform() < 0.5});
      num_true += predictions.back().is_true ? 1U : 0U;
    }
    const std::size_t num_truths = num_true + 1 + static_cast<std::size_t>(round % 3);
    const double area = average_precision(predictions, num_truths).value();
    EXPECT_NEAR(area, area_by_thresholds(predictions, num_truths), 1e-12);
    EXPECT_GE(area, 0.0);
    EXPECT_LE(area, 1.0);
    for (std::size_t i = predictions.size(); i > 1; --i)
      std::swap(predictions[i - 1], predictions[below(i)]);
    EXPECT_EQ(average_precision(predictions, num_truths).value(), area);
  }
}

}  // namespace
}  // namespace hypermap

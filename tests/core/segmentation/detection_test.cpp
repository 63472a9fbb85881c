// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/detection.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hypermap {
namespace {

double sum_of(const std::vector<ClassEvidence>& scores) {
  double sum = 0.0;
  for (const ClassEvidence& score : scores) sum += score.probability.value();
  return sum;
}

TEST(BestClass, IsTheMostProbableAndTheLowestIdOfEquals) {
  const std::vector<ClassEvidence> scores{{ClassId{1}, Probability(0.2)},
                                          {ClassId{4}, Probability(0.4)},
                                          {ClassId{7}, Probability(0.4)}};
  EXPECT_EQ(best_class(scores)->id, ClassId{4});
  EXPECT_FALSE(best_class({}).has_value());
}

// [smap] Eq. (3.1), Eq. (3.2), Eq. (3.3): a class vector, no entry below 0, sum 1. (1 - 0.7) / 3 =
// 0.1 for each other class.
TEST(SpreadScore, GivesTheRestToTheOtherClassesEvenly) {
  const std::vector<ClassId> known{{5}, {1}, {3}, {2}};
  const auto scores = spread_score(ClassId{3}, Probability(0.7), known);
  ASSERT_EQ(scores.size(), 4U);
  EXPECT_EQ(scores[0].id, ClassId{1});
  EXPECT_NEAR(scores[0].probability.value(), 0.1, 1e-12);
  EXPECT_EQ(scores[2].id, ClassId{3});
  EXPECT_EQ(scores[2].probability, Probability(0.7));
  EXPECT_NEAR(sum_of(scores), 1.0, 1e-12);
}

TEST(SpreadScore, IsCertainWhenOnlyOneClassIsKnown) {
  const std::vector<ClassId> known{{3}};
  EXPECT_EQ(spread_score(ClassId{3}, Probability(0.2), known),
            (std::vector<ClassEvidence>{{ClassId{3}, Probability(1.0)}}));
}

// [smap] Eq. (3.3), the class vector of each row of Eq. (3.4): 0.2 + 0.6 = 0.8; 0.6 / 0.8 = 0.75.
TEST(Normalized, ScalesToSumOneAndSortsById) {
  const auto scores =
      normalized({{ClassId{9}, Probability(0.6)}, {ClassId{2}, Probability(0.2)}}).value();
  EXPECT_EQ(scores[0].id, ClassId{2});
  EXPECT_NEAR(scores[1].probability.value(), 0.75, 1e-12);
  EXPECT_NEAR(sum_of(scores), 1.0, 1e-12);
}

TEST(Normalized, RefusesNothingToScaleAndClassesNamedTwice) {
  EXPECT_EQ(normalized({}).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(normalized({{ClassId{1}, Probability(0.0)}}).error().field, "class_scores");
  EXPECT_EQ(
      normalized({{ClassId{1}, Probability(0.5)}, {ClassId{1}, Probability(0.5)}}).error().code,
      ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/map_comparison.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace hypermap {
namespace {

/// One truth after the other, each at the distance with the Jaccard index beside it.
struct Found {
  double distance_m = 0.0;
  double jaccard = 0.0;
};

EvaluationReport report_of(const std::vector<std::optional<Found>>& truths) {
  EvaluationReport report;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    TruthResult truth;
    truth.truth_index = i;
    if (truths[i]) {
      truth.nearest_map_index = i;
      truth.nearest_distance_m = truths[i]->distance_m;
      truth.aligned_jaccard = truths[i]->jaccard;
    }
    report.truths.push_back(truth);
  }
  return report;
}

TEST(MapComparison, ABetterMapIsSoByChanceInOneOfEightCases) {
  // Three truths, each nearer and better covered in the first map: all three signs are positive,
  // 1 of 2^3 patterns. The other way round every pattern has a rank sum of at least 0: p = 1.
  const auto good = report_of({{{0.1, 0.9}}, {{0.1, 0.8}}, {{0.2, 0.7}}});
  const auto bad = report_of({{{0.2, 0.5}}, {{0.4, 0.5}}, {{0.5, 0.5}}});
  const auto better = compare(good, bad).value();
  EXPECT_DOUBLE_EQ(better.jaccard.p, 0.125);
  EXPECT_DOUBLE_EQ(better.distance.p, 0.125);
  const auto worse = compare(bad, good).value();
  EXPECT_DOUBLE_EQ(worse.jaccard.p, 1.0);
  EXPECT_DOUBLE_EQ(worse.distance.p, 1.0);
}

TEST(MapComparison, ATruthThatOneMapDoesNotKnowIsNotCompared) {
  const auto first = report_of({{{0.1, 0.9}}, std::nullopt, {{0.1, 0.9}}});
  const auto second = report_of({{{0.2, 0.5}}, {{0.1, 0.9}}, std::nullopt});
  EXPECT_EQ(compare(first, second).value().jaccard.n, 1U);
}

TEST(MapComparison, ReportsOfDifferentTruthsAreRefused) {
  const auto two = report_of({{{0.1, 0.9}}, {{0.1, 0.9}}});
  const auto one = report_of({{{0.1, 0.9}}});
  EXPECT_EQ(compare(two, one).error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/run_rates.hpp"

#include "hypermap/core/base/random_numbers.hpp"
#include "hypermap/core/evaluation/average_precision.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace hypermap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TurnedBox cube_at(const Eigen::Vector3d& centre) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);
  return {.low = centre - half, .high = centre + half};
}

/// A cube of 1 m on the x axis.
RatedObject rated_object(double x,
                         double confidence,
                         const std::string& class_name = "chair",
                         bool is_confirmed = true) {
  const Eigen::Vector3d centre(x, 0, 0);
  return {.id = static_cast<std::uint64_t>(1000.0 + 100.0 * x),
          .class_name = class_name,
          .place = centre,
          .centre = centre,
          .box = cube_at(centre),
          .is_confirmed = is_confirmed,
          .confidence = confidence};
}

RatedTruth rated_truth(double x,
                       std::optional<std::size_t> object = std::nullopt,
                       std::vector<std::string> class_names = {"chair"}) {
  const Eigen::Vector3d centre(x, 0, 0);
  return {.reference = std::to_string(static_cast<int>(x)),
          .class_names = std::move(class_names),
          .place = centre,
          .gate_m = 0.5,
          .centre = centre,
          .box = cube_at(centre),
          .object = object};
}

std::vector<std::pair<double, bool>> ranking(const RunRates& rates,
                                             const std::string& name,
                                             MatchCriterion criterion = MatchCriterion::kDistance) {
  std::vector<std::pair<double, bool>> pairs;
  for (const Prediction& one : rates.classes.at(name).ranked[static_cast<std::size_t>(criterion)])
    pairs.emplace_back(one.probability, one.is_true);
  return pairs;
}

// [smap] B.1: two of three chairs are found, one object is false; of three rejected candidates
// one is the missed chair, so two are rightly rejected.
TEST(RunRates, NegativesAreWhatTheMapRejected) {
  const RatedRun run{.objects = {rated_object(0.1, 0.9),
                                 rated_object(2.0, 0.8),
                                 rated_object(9.0, 0.7),
                                 rated_object(4.2, 0.3, "chair", false),
                                 rated_object(7.0, 0.2, "chair", false),
                                 rated_object(0.2, 0.1, "chair", false)},
                     .truths = {rated_truth(0, 0), rated_truth(2, 1), rated_truth(4)}};
  const BinaryCounts expected{
      .true_positives = 2, .false_positives = 1, .false_negatives = 1, .true_negatives = 2};
  const RunRates rates = run_rates(run);
  EXPECT_EQ(rates.classes.at("chair").counts, expected);
  ASSERT_EQ(rates.false_objects.size(), 1U);
  EXPECT_DOUBLE_EQ(rates.false_objects.front().place.x(), 9.0);
  EXPECT_EQ(rates.false_objects.front().confidence, 0.7);
  RatedRun without = run;
  without.has_tentative = false;
  EXPECT_FALSE(run_rates(without).classes.at("chair").counts.true_negatives);
}

TEST(RunRates, WhatLiesAtATruthThatDoesNotCountIsNeither) {
  RatedRun run{.objects = {rated_object(0.1, 0.9), rated_object(5.1, 0.3, "chair", false)},
               .truths = {rated_truth(0), rated_truth(5)}};
  run.objects[0].is_apart = true;
  for (RatedTruth& truth : run.truths) truth.counts = false;
  const RunRates rates = run_rates(run);
  EXPECT_EQ(rates.classes.at("chair").counts, BinaryCounts{});
  EXPECT_TRUE(rates.false_objects.empty());
  EXPECT_THAT(ranking(rates, "chair"), IsEmpty());
}

TEST(RunRates, TheSurestChooseFirst) {
  // Both are within the gate of one truth; the surer one is farther.
  const RatedRun run{.objects = {rated_object(0.1, 0.4), rated_object(0.3, 0.6)},
                     .truths = {rated_truth(0, 0)}};
  const RunRates rates = run_rates(run);
  EXPECT_THAT(ranking(rates, "chair"), ElementsAre(std::pair(0.6, true), std::pair(0.4, false)));
}

TEST(RunRates, EqualsChooseTogether) {
  // By itself the first would take the nearer truth at 0.4 and leave the second none.
  const RatedRun run{.objects = {rated_object(0.3, 0.5), rated_object(0.8, 0.5)},
                     .truths = {rated_truth(0), rated_truth(0)}};
  RatedRun two = run;
  two.truths[1] = rated_truth(0);
  two.truths[1].place.x() = 0.4;
  EXPECT_THAT(ranking(run_rates(two), "chair"),
              ElementsAre(std::pair(0.5, true), std::pair(0.5, true)));
}

// Cubes of 1 m that are d apart along an edge overlap by (1 - d) / (1 + d).
TEST(RunRates, OverlapsAskForMoreThanDistance) {
  const auto right_at = [](double x, MatchCriterion criterion) {
    const RatedRun run{.objects = {rated_object(x, 0.5)}, .truths = {rated_truth(0)}};
    return ranking(run_rates(run), "chair", criterion).front().second;
  };
  EXPECT_TRUE(right_at(0.5, MatchCriterion::kDistance));
  EXPECT_FALSE(right_at(0.51, MatchCriterion::kDistance));
  EXPECT_TRUE(right_at(0.59, MatchCriterion::kOverlap25));
  EXPECT_FALSE(right_at(0.61, MatchCriterion::kOverlap25));
  EXPECT_TRUE(right_at(0.33, MatchCriterion::kOverlap50));
  EXPECT_FALSE(right_at(0.34, MatchCriterion::kOverlap50));
}

TEST(RunRates, ErrorsAreTrueMinusMapped) {
  const RatedRun run{.objects = {rated_object(0.25, 0.5)}, .truths = {rated_truth(0, 0)}};
  const RunRates rates = run_rates(run);
  EXPECT_TRUE(rates.truths[0].error_m->isApprox(Eigen::Vector3d(-0.25, 0, 0)));
  EXPECT_NEAR(*rates.truths[0].overlap, 0.6, 1e-9);
  EXPECT_EQ(rates.truths[0].object_id, 1025U);
  EXPECT_THAT(rates.classes.at("chair").errors_m, SizeIs(1));
  EXPECT_THAT(rates.classes.at("chair").overlaps, SizeIs(1));
}

TEST(RunRates, AFurtherRightClassCountsInTheTruthsOwn) {
  const RatedRun run{.objects = {rated_object(0.1, 0.6, "bench"), rated_object(8.0, 0.5, "bench")},
                     .truths = {rated_truth(0, 0, {"sofa", "bench"})}};
  const RunRates rates = run_rates(run);
  EXPECT_EQ(rates.classes.at("sofa").counts.true_positives, 1U);
  EXPECT_EQ(rates.classes.at("bench").counts.false_positives, 1U);
  EXPECT_THAT(ranking(rates, "sofa"), ElementsAre(std::pair(0.6, true)));
  EXPECT_THAT(ranking(rates, "bench"), ElementsAre(std::pair(0.5, false)));
}

TEST(RunRates, WithoutBeliefsNothingIsRanked) {
  RatedRun run{.objects = {rated_object(0, 0.6), rated_object(1, 0.6)},
               .truths = {rated_truth(0, 0)}};
  run.objects[1].confidence = std::nullopt;
  const RunRates rates = run_rates(run);
  EXPECT_FALSE(rates.has_confidences);
  EXPECT_THAT(ranking(rates, "chair"), IsEmpty());
  EXPECT_EQ(rates.classes.at("chair").counts.true_positives, 1U);
}

// [smap] Eq. (B.5): of four classified objects three are named rightly.
TEST(RunRates, ClassesAreRightOrWrongOfAll) {
  EXPECT_DOUBLE_EQ(*(Classifications{.num_all = 4, .num_right = 3}.accuracy()), 0.75);
  EXPECT_FALSE(Classifications{}.accuracy());
}

TEST(RunRates, OrderChangesNothing) {
  CounterRng random(11, 0);
  const auto below = [&random](std::size_t n) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(n));
  };
  const auto shuffle = [&below](auto& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[below(i)]);
  };
  for (int round = 0; round < 100; ++round) {
    RatedRun run;
    const std::size_t num_objects = below(9);
    const std::size_t num_truths = below(6);
    for (std::size_t i = 0; i < num_objects; ++i) {
      const double confidence = 0.25 * static_cast<double>(below(4));
      run.objects.push_back(rated_object(
          3.0 * random.uniform(), confidence, below(2) == 0 ? "chair" : "sofa", below(2) == 0));
    }
    for (std::size_t i = 0; i < num_truths; ++i) {
      run.truths.push_back(rated_truth(3.0 * random.uniform()));
      run.truths.back().counts = below(4) > 0;
    }
    RatedRun shuffled = run;
    shuffle(shuffled.objects);
    shuffle(shuffled.truths);
    const RunRates a = run_rates(run);
    const RunRates b = run_rates(shuffled);
    ASSERT_EQ(a.classes.size(), b.classes.size());
    for (const auto& [name, of_class] : a.classes) {
      EXPECT_EQ(of_class.counts, b.classes.at(name).counts);
      for (const MatchCriterion criterion : kMatchCriteria)
        EXPECT_EQ(ranking(a, name, criterion), ranking(b, name, criterion));
    }
  }
}

}  // namespace
}  // namespace hypermap

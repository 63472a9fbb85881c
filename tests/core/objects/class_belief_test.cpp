// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/class_belief.hpp"

#include <gtest/gtest.h>

#include <array>

namespace hypermap {
namespace {

constexpr ClassId kBelievedClass{0};
constexpr ClassId kSofa{1};
constexpr Probability kEven{0.5};

ClassBelief clamping() {
  return ClassBelief::create({.saturation = Saturation::kClamp}).value();
}

TEST(ClassBelief, AClassNeverObservedIsAsLikelyAsNot) {
  EXPECT_DOUBLE_EQ(ClassBelief().log_odds(kSofa).probability().value(), 0.5);
  EXPECT_FALSE(ClassBelief().best().has_value());
  EXPECT_TRUE(ClassBelief().distribution().empty());
}

TEST(ClassBelief, TwoEqualObservationsAddTheirLogOdds) {
  // [smap] Eq. (3.19): 2 ln(0.8 / 0.2) = 2.7725887.
  ClassBelief belief;
  const std::array evidence{ClassEvidence{kBelievedClass, Probability(0.8)}};
  belief.observe(evidence, kEven);
  belief.observe(evidence, kEven);
  EXPECT_NEAR(belief.log_odds(kBelievedClass).value(), 2.7725887, 1e-7);
}

TEST(ClassBelief, TheUpdateIsThatOfProbabilities) {
  // [smap] Eq. (3.18) with p_k = 0.6, p_(1:k-1) = 0.7, prior 0.25:
  // 1 / (1 + (0.4 / 0.6) (0.3 / 0.7) (0.25 / 0.75)) = 1 / (1 + 0.0952381) = 0.9130435.
  // In log-odds the first step has to bring 0.7 against the prior: l = ln(0.7 / 0.3).
  auto belief =
      ClassBelief::from_entries({}, {{kBelievedClass, LogOdds::of(Probability(0.7))}}).value();
  belief.observe(std::array{ClassEvidence{kBelievedClass, Probability(0.6)}}, Probability(0.25));
  EXPECT_NEAR(belief.log_odds(kBelievedClass).probability().value(), 0.9130435, 1e-7);
}

TEST(ClassBelief, ADetectorThatKnowsNothingChangesNothing) {
  // [smap] Eq. (3.18): logit(1/80) - logit(1/80) = 0.
  ClassBelief belief;
  const Probability uniform(1.0 / 80.0);
  for (int i = 0; i < 100; ++i)
    belief.observe(std::array{ClassEvidence{kBelievedClass, uniform}}, uniform);
  EXPECT_DOUBLE_EQ(belief.log_odds(kBelievedClass).value(), 0.0);
}

TEST(ClassBelief, OrderDoesNotMatterBelowTheBounds) {
  const std::array weak{ClassEvidence{kBelievedClass, Probability(0.6)}};
  const std::array against{ClassEvidence{kBelievedClass, Probability(0.3)}};
  ClassBelief forward;
  forward.observe(weak, kEven);
  forward.observe(against, kEven);
  ClassBelief backward;
  backward.observe(against, kEven);
  backward.observe(weak, kEven);
  EXPECT_NEAR(
      forward.log_odds(kBelievedClass).value(), backward.log_odds(kBelievedClass).value(), 1e-12);
}

TEST(ClassBelief, ACertainDetectorSaturatesAndCanStillBeOverturned) {
  auto belief = clamping();
  belief.observe(std::array{ClassEvidence{kBelievedClass, Probability(1.0)}}, kEven);
  EXPECT_DOUBLE_EQ(belief.log_odds(kBelievedClass).value(), 10.0);
  const std::array against{ClassEvidence{kBelievedClass, Probability(0.2)}};
  for (int i = 0; i < 20; ++i) belief.observe(against, kEven);
  EXPECT_LT(belief.log_odds(kBelievedClass), LogOdds{});
}

TEST(ClassBelief, ASimilarClassNeverCatchesUpWhenTheBeliefShifts) {
  // A chair of which every detection says 0.7 chair, 0.15 sofa, among 80 classes: both are above
  // 1/80, so that both reach the bound when each is clamped by itself.
  const std::array evidence{ClassEvidence{kBelievedClass, Probability(0.7)},
                            ClassEvidence{kSofa, Probability(0.15)}};
  auto clamped = clamping();
  ClassBelief shifted;
  for (int i = 0; i < 10; ++i) {
    clamped.observe(evidence, Probability(1.0 / 80.0));
    shifted.observe(evidence, Probability(1.0 / 80.0));
  }
  EXPECT_EQ(clamped.log_odds(kBelievedClass), clamped.log_odds(kSofa));
  EXPECT_DOUBLE_EQ(shifted.log_odds(kBelievedClass).value(), 10.0);
  EXPECT_LT(shifted.log_odds(kSofa), LogOdds{});
}

TEST(ClassBelief, AnAbsenceWeakensAllClassesAlike) {
  ClassBelief belief;
  belief.observe(std::array{ClassEvidence{kBelievedClass, Probability(0.8)},
                            ClassEvidence{kSofa, Probability(0.6)}},
                 kEven);
  const LogOdds before = belief.log_odds(kBelievedClass) - belief.log_odds(kSofa);
  belief.weaken(LogOdds(0.5));
  EXPECT_NEAR(belief.log_odds(kBelievedClass).value(), 1.3862944 - 0.5, 1e-7);
  EXPECT_NEAR(
      (belief.log_odds(kBelievedClass) - belief.log_odds(kSofa)).value(), before.value(), 1e-12);
}

TEST(ClassBelief, TheDistributionIsProportionalToTheOdds) {
  // e^2 and e^0: 7.389 / 8.389 = 0.8808.
  const auto belief =
      ClassBelief::from_entries({}, {{kBelievedClass, LogOdds(2.0)}, {kSofa, LogOdds(0.0)}})
          .value();
  EXPECT_NEAR(belief.distribution()[0].probability.value(), 0.8808, 1e-4);
  EXPECT_NEAR(belief.distribution()[1].probability.value(), 0.1192, 1e-4);
}

TEST(ClassBelief, MergingAddsTheEvidence) {
  auto a = ClassBelief::from_entries({}, {{kBelievedClass, LogOdds(2.0)}}).value();
  a.merge(ClassBelief::from_entries({}, {{kBelievedClass, LogOdds(1.0)}, {kSofa, LogOdds(-1.0)}})
              .value());
  EXPECT_EQ(a.entries().size(), 2U);
  EXPECT_DOUBLE_EQ(a.log_odds(kBelievedClass).value(), 3.0);
  EXPECT_DOUBLE_EQ(a.log_odds(kSofa).value(), -1.0);
}

TEST(ClassBelief, MergingMayWeigh) {
  auto a = ClassBelief::from_entries({}, {{kBelievedClass, LogOdds(2.0)}}).value();
  a.merge(ClassBelief::from_entries({}, {{kSofa, LogOdds(8.0)}}).value(), 0.25);
  EXPECT_DOUBLE_EQ(a.log_odds(kSofa).value(), 2.0);
}

TEST(ClassBelief, WhatIsStoredComesBack) {
  ClassBelief belief;
  belief.observe(std::array{ClassEvidence{kSofa, Probability(0.3)},
                            ClassEvidence{kBelievedClass, Probability(0.9)}},
                 Probability(0.1));
  const std::vector<ClassLogOdds> entries(belief.entries().begin(), belief.entries().end());
  EXPECT_EQ(ClassBelief::from_entries(belief.options(), entries).value(), belief);
}

TEST(ClassBelief, BadBoundsAndEntriesAreRefusedWithAReason) {
  EXPECT_EQ(
      ClassBelief::create({.max_log_odds = LogOdds(-1), .min_log_odds = LogOdds(1)}).error().field,
      "min_log_odds");
  EXPECT_FALSE(ClassBelief::from_entries({}, {{kBelievedClass, LogOdds(11.0)}}).has_value());
  EXPECT_FALSE(
      ClassBelief::from_entries({}, {{kSofa, LogOdds{}}, {kBelievedClass, LogOdds{}}}).has_value());
  EXPECT_FALSE(ClassBelief::from_entries({}, {{kSofa, LogOdds{}}, {kSofa, LogOdds{}}}).has_value());
}

}  // namespace
}  // namespace hypermap

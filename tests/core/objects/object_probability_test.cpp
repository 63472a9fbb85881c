// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace hypermap {
namespace {

constexpr ClassId kMicrowave{0};
constexpr ClassId kRefrigerator{1};
constexpr ClassId kNamedTv{2};
constexpr ClassId kNamedOven{3};
constexpr ClassId kVase{4};  // never named

/// An object that knows all five classes and that nobody saw.
Object unseen(ClassTempering tempering = ClassTempering::kViews) {
  Object object;
  const LogOdds l{0.0};
  object.belief =
      ClassBelief::from_entries(
          {.tempering = tempering},
          {{kMicrowave, l}, {kRefrigerator, l}, {kNamedTv, l}, {kNamedOven, l}, {kVase, l}})
          .value();
  return object;
}

/// Named `times` times from a bearing in the middle of bin `direction`.
void name(Object& object, ClassId id, int times, int direction = 0) {
  const double bin_rad = 2.0 * M_PI / ObservationLog::kNumBearingBins;
  for (int i = 0; i < times; ++i) {
    object.observation_log.add({.class_id = id,
                                .score = 0.7F,
                                .bearing_rad = static_cast<float>(bin_rad * (direction + 0.5)),
                                .distance_m = 2.0F});
  }
}

/// Not detected, `times` times, though so much of it was visible.
void miss(Object& object, float visible_share, int times = 1) {
  for (int i = 0; i < times; ++i) {
    object.observation_log.add({.kind = ObservationKind::kMissedDetection, .score = visible_share});
  }
}

/// Looked through, `looks` times, 0.5 s after each other.
void look_through(Object& object, int looks) {
  for (int i = 0; i < looks; ++i) {
    object.observation_log.add({.stamp = Stamp{500'000'000LL * i},
                                .kind = ObservationKind::kMissedDetection,
                                .visibility = Visibility::kAbsent});
  }
}

double probability_of(const Object& object, ClassId id) {
  for (const ClassEvidence& c : class_distribution(object)) {
    if (c.id == id) return c.probability.value();
  }
  return -1.0;
}

TEST(ClassDistribution, EachViewHasTheRootOfItsDetectionsToShareOut) {
  // docs/EVALUATION.md, "Calibration". View 0: four detections, root 2: microwave 3/4 of it, tv
  // 1/4. View 5: one, tv. Microwave 1.5, tv 0.5 + 1 = 1.5; squares 2.25 each, 0.2 for the rest.
  Object object = unseen();
  name(object, kMicrowave, 3, 0);
  name(object, kNamedTv, 1, 0);
  name(object, kNamedTv, 1, 5);
  EXPECT_NEAR(probability_of(object, kMicrowave), 2.25 / 4.7, 1e-12);
  EXPECT_NEAR(probability_of(object, kNamedTv), 2.25 / 4.7, 1e-12);
  EXPECT_NEAR(probability_of(object, kVase), 0.2 / 3.0 / 4.7, 1e-12);
}

TEST(ClassDistribution, SumsToOneAndAscends) {
  Object object = unseen();
  name(object, kNamedTv, 2);
  name(object, ClassId{9}, 1, 3);  // of a class that the belief does not know
  double sum = 0.0;
  const auto classes = class_distribution(object);
  for (const ClassEvidence& c : classes) sum += c.probability.value();
  EXPECT_NEAR(sum, 1.0, 1e-12);
  ASSERT_EQ(classes.size(), 6U);
  EXPECT_EQ(classes.back().id, ClassId{9});
}

TEST(ClassDistribution, WhatWasNamedLessOftenKeepsAShareThatFollowsItsCount) {
  // A recorded cabinet that has no name of its own was named so, of one and the same view each.
  Object object = unseen();
  name(object, kMicrowave, 13, 4);
  name(object, kRefrigerator, 13, 4);
  name(object, kNamedTv, 6, 4);
  name(object, kNamedOven, 3, 4);
  EXPECT_DOUBLE_EQ(probability_of(object, kMicrowave), probability_of(object, kRefrigerator));
  EXPECT_LT(probability_of(object, kMicrowave), 0.5);
  EXPECT_NEAR(
      probability_of(object, kNamedTv) / probability_of(object, kMicrowave), 36.0 / 169.0, 1e-9);
  EXPECT_NEAR(
      probability_of(object, kNamedOven) / probability_of(object, kNamedTv), 9.0 / 36.0, 1e-9);
}

TEST(ClassDistribution, AHundredFramesOfOneViewAreNoHundredViews) {
  // The root of a hundred is ten: four views with five frames each, root 2.24, say as much.
  Object object = unseen();
  name(object, kNamedOven, 100, 0);
  for (int view = 1; view <= 5; ++view) name(object, kNamedTv, 5, view);
  EXPECT_EQ(best_class(object)->id, kNamedTv);
  EXPECT_GT(probability_of(object, kNamedOven), 0.4);
}

TEST(ClassDistribution, WithoutTemperingOrDetectionsItIsTheBeliefs) {
  Object object = unseen(ClassTempering::kNone);
  name(object, kNamedTv, 3);
  EXPECT_EQ(class_distribution(object), object.belief.distribution());
  EXPECT_EQ(class_distribution(unseen()), unseen().belief.distribution());
  EXPECT_TRUE(class_distribution(Object{}).empty());
}

TEST(ClassDistribution, OfEqualsTheMoreBelievedIsTheBest) {
  Object object = unseen();
  name(object, kMicrowave, 2);
  name(object, kRefrigerator, 2);
  EXPECT_EQ(best_class(object)->id, kMicrowave) << "the lowest id";
  object.belief.observe({{{kRefrigerator, Probability(0.9)}}}, Probability(0.2));
  EXPECT_EQ(best_class(object)->id, kRefrigerator);
}

TEST(RealProbability, IsLogisticInDetectionsDirectionsAndMisses) {
  // docs/EVALUATION.md, "Calibration": -0.08 + 2.62 ln 4 + 1.52 ln 2 = 4.6057; 1 / (1 + e^-4.6057).
  Object object = unseen();
  name(object, kNamedTv, 3, 0);
  name(object, kNamedTv, 1, 1);
  EXPECT_NEAR(real_probability(object).value(), 0.99010, 1e-4);
  // - 2.18 ln(1 + 4 * 0.75) = -3.0221.
  miss(object, 0.75F, 4);
  EXPECT_NEAR(real_probability(object).value(), 0.82973, 1e-4);
}

TEST(RealProbability, IsLessForWhatIsNamedOtherwise) {
  // The same with one of four of another class: 4.6057 - 4.76 / 4 = 3.4157.
  Object object = unseen();
  name(object, kNamedTv, 3, 0);
  name(object, kNamedOven, 1, 1);
  EXPECT_NEAR(real_probability(object).value(), 0.96819, 1e-4);
}

TEST(RealProbability, ADetectorWithOtherWordsNamesNothingOtherwise) {
  Object object = unseen();
  name(object, kNamedTv, 4);
  for (int i = 0; i < 4; ++i)
    object.observation_log.add({.detector = DetectorId{1}, .class_id = kNamedOven});
  EXPECT_EQ(detection_regularity(object.observation_log).num_named_otherwise, 0U);
  name(object, kNamedOven, 1);
  EXPECT_EQ(detection_regularity(object.observation_log).num_named_otherwise, 1U);
}

TEST(RealProbability, OfAFileThatSaysThatLessThanNothingWasVisibleIsANumber) {
  Object object = unseen();
  name(object, kNamedTv, 4);
  const double before = real_probability(object).value();
  miss(object, -5.0F);
  EXPECT_EQ(real_probability(object).value(), before);
}

TEST(RealProbability, OfOneDetectionAloneIsSmall) {
  // -0.08 - 2.47 = -2.55; two of one view: -0.08 + 2.62 ln 2 = 1.7360.
  Object object = unseen();
  name(object, kNamedTv, 1);
  EXPECT_NEAR(real_probability(object).value(), 0.07243, 1e-4);
  name(object, kNamedTv, 1);
  EXPECT_NEAR(real_probability(object).value(), 0.85018, 1e-4);
}

TEST(RealProbability, WhatIsSeenAndSeldomDetectedIsAFalseAlarmAtAnyCount) {
  Object often = unseen();
  Object seldom = unseen();
  name(often, kNamedTv, 8);
  name(seldom, kNamedTv, 8);
  miss(often, 1.0F, 3);
  miss(seldom, 1.0F, 40);
  EXPECT_GT(real_probability(often).value(), 0.5);
  EXPECT_LT(real_probability(seldom).value(), 0.1);
}

TEST(RealProbability, WhatIsGoneIsNotReal) {
  Object object = unseen();
  for (int view = 0; view < 18; ++view) name(object, kNamedTv, 10, view);
  look_through(object, 4);
  EXPECT_GT(real_probability(object).value(), 0.99);
  look_through(object, 5);
  EXPECT_NEAR(real_probability(object).value(), 1.0 / (1.0 + std::exp(9.0)), 1e-9);
}

TEST(RealProbability, WhoWalkedByIsNotRealOnceThreeLooksDenyIt) {
  Object object = unseen();
  name(object, kNamedTv, 4);
  look_through(object, 2);
  const double before = real_probability(object).value();
  look_through(object, 1);
  EXPECT_GT(before, 0.5);
  EXPECT_NEAR(real_probability(object).value(), 1.0 / (1.0 + std::exp(3.0)), 1e-9);
}

TEST(RealProbability, WithoutDetectionsItIsThatOfTheExistence) {
  Object object;
  object.existence = LogOdds(1.5);
  EXPECT_DOUBLE_EQ(real_probability(object).value(), LogOdds(1.5).probability().value());
}

TEST(ObjectConfidence, IsTheProbabilityOfBeingRealAndOfThatClass) {
  Object object = unseen();
  name(object, kNamedTv, 3);
  name(object, kNamedOven, 2, 1);
  const double expected =
      real_probability(object).value() * best_class(object)->probability.value();
  EXPECT_DOUBLE_EQ(object_confidence(object).value(), expected);
  EXPECT_GT(expected, 0.3);
  EXPECT_DOUBLE_EQ(object_confidence(Object{}).value(), 0.0);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/class_prior.hpp"

#include "hypermap/core/objects/association.hpp"
#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hypermap {
namespace {

constexpr ClassId kMug{0};
constexpr ClassId kBottle{1};
constexpr ClassId kSink{2};

/// Of each class how many times as probable.
ClassPrior prior_for(double bottle, double sink) {
  return ClassPrior::create(
             {{kBottle, LogOdds(std::log(bottle))}, {kSink, LogOdds(std::log(sink))}})
      .value();
}

TEST(ClassPrior, MultipliesAndNormalises) {
  // [smap] Eq. (3.17): 0.5, 0.4, 0.1 times 1, 2, 0.5: 0.5, 0.8, 0.05 of 1.35.
  const auto posterior =
      with_prior({{kMug, Probability(0.5)}, {kBottle, Probability(0.4)}, {kSink, Probability(0.1)}},
                 prior_for(2.0, 0.5));
  EXPECT_NEAR(posterior[0].probability.value(), 0.5 / 1.35, 1e-12);
  EXPECT_NEAR(posterior[1].probability.value(), 0.8 / 1.35, 1e-12);
  EXPECT_NEAR(posterior[2].probability.value(), 0.05 / 1.35, 1e-12);
}

TEST(ClassPrior, OneThatSaysNothingChangesNoBit) {
  const std::vector<ClassEvidence> classes{{kMug, Probability(1.0 / 3.0)},
                                           {kSink, Probability(0.2)}};
  EXPECT_EQ(with_prior(classes, {}), classes);
  EXPECT_EQ(ClassPrior().factor(kMug), 1.0);
}

TEST(ClassPrior, WhatIsNoPriorIsRefused) {
  EXPECT_FALSE(ClassPrior::create({{kSink, LogOdds(0.1)}, {kMug, LogOdds(0.1)}}));
  EXPECT_FALSE(ClassPrior::create({{kSink, LogOdds(0.1)}, {kSink, LogOdds(0.1)}}));
  EXPECT_FALSE(ClassPrior::create({{kSink, LogOdds(-20.1)}}));
}

/// An object that one view showed so often as a cup and so often as a bottle.
Object doubtful(int num_cup,
                int num_bottle,
                const ClassBeliefOptions& options = {},
                const ClassPrior& prior = prior_for(4.0, 1.0)) {
  AssociationOptions association;
  association.belief = options;
  Observation observation;
  observation.segment.box = testing_support::box_at({0, 0, 1}, {0.1, 0.1, 0.1});
  observation.segment.points_in_map = testing_support::surface_of(observation.segment.box);
  observation.segment.box_confidence = Probability(0.8);
  observation.prior = prior;
  observation.num_classes = 2;
  Object object;
  for (int i = 0; i < num_cup + num_bottle; ++i) {
    const double cup = i < num_cup ? 0.9 : 0.1;
    observation.class_scores = {{kMug, Probability(cup)}, {kBottle, Probability(1.0 - cup)}};
    observation.frame_index = static_cast<std::uint64_t>(i);
    if (i == 0) object = make_object(observation, association);
    if (i > 0) update_object(object, observation, association);
  }
  return object;
}

TEST(ClassPrior, ByViewsItIsAppliedOnceHoweverOftenTheObjectWasSeen) {
  // Weights (0.6 sqrt n)^2 and 4 (0.4 sqrt n)^2: 0.36 and 0.64, at 10 as at 200 observations.
  for (const int times : {1, 20}) {
    const auto classes = class_distribution(doubtful(6 * times, 4 * times));
    ASSERT_EQ(classes.size(), 2U);
    EXPECT_NEAR(classes[1].probability.value(), 0.64, 1e-9) << times;
    const auto detected = detected_distribution(doubtful(6 * times, 4 * times));
    EXPECT_NEAR(detected[1].probability.value(), 0.16 / 0.52, 1e-9);
  }
}

TEST(ClassPrior, ByViewsItDoesNotSayWhichObservationsAreOfOneObject) {
  const Object known = doubtful(6, 4);
  const Object unknown = doubtful(6, 4, {}, {});
  ASSERT_FALSE(known.prior.empty());
  EXPECT_EQ(known.belief, unknown.belief);
  EXPECT_EQ(known.observation_log, unknown.observation_log);
}

TEST(ClassPrior, AMapIsAskedForTheClassThatObjectsAreReadAs) {
  // Bottle 0.64 with what is known, cup by detections alone.
  ObjectMap map;
  const ObjectId id = map.add(doubtful(6, 4));
  EXPECT_EQ(map.nearest({{0, 0, 0}}, kBottle), id);
  EXPECT_EQ(map.nearest({{0, 0, 0}}, kMug), std::nullopt);
}

TEST(ClassPrior, UnderTheSumEachObservationBearsIt) {
  // [smap] Eq. (3.17), (3.18) with N = 2: bottle 0.1 * 4 / (0.9 + 0.4) = 4/13, logit ln(4/9).
  ClassBeliefOptions options;
  options.tempering = ClassTempering::kNone;
  const Object object = doubtful(3, 0, options);
  EXPECT_NEAR(object.belief.log_odds(kBottle).value(), 3.0 * std::log(4.0 / 9.0), 1e-9);
  EXPECT_EQ(class_distribution(object), object.belief.distribution());
}

TEST(ClassPrior, OfMergedObjectsTheOneOfMoreObservationsKeepsIts) {
  Object a = doubtful(2, 0);
  Object b = doubtful(5, 0);
  a.id = ObjectId{1};
  b.id = ObjectId{2};
  b.prior = prior_for(2.0, 1.0);
  EXPECT_EQ(merged(a, b, LogOdds(20.0)).prior, b.prior);
}

}  // namespace
}  // namespace hypermap

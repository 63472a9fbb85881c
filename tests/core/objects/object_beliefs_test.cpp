// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_beliefs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hypermap {
namespace {

constexpr ClassId kNeverNamed{0};
constexpr ClassId kNamedThrice{1};
constexpr ClassId kNamedTwice{2};

/// Named sofa three times, bench twice, never bed; all of one direction.
Object sofa_or_bench() {
  Object object;
  const LogOdds l{0.0};
  object.belief =
      ClassBelief::from_entries({}, {{kNeverNamed, l}, {kNamedThrice, l}, {kNamedTwice, l}})
          .value();
  for (const ClassId id : {kNamedThrice, kNamedThrice, kNamedThrice, kNamedTwice, kNamedTwice}) {
    object.observation_log.add({.class_id = id, .score = 0.7F, .distance_m = 2.0F});
  }
  return object;
}

TEST(ClassEntropy, OfTwoEquallyProbableClassesIsTheLogarithmOfTwo) {
  const std::array two{ClassEvidence{kNeverNamed, Probability(0.5)},
                       ClassEvidence{kNamedThrice, Probability(0.5)}};
  EXPECT_NEAR(entropy_nats(two).value(), std::log(2.0), 1e-15);
}

TEST(ClassEntropy, OfACertainClassIsZero) {
  const std::array certain{ClassEvidence{kNeverNamed, Probability(0.0)},
                           ClassEvidence{kNamedThrice, Probability(1.0)}};
  EXPECT_EQ(entropy_nats(certain), 0.0);
}

TEST(ClassEntropy, IsInNats) {
  // 1/4 ln 4 + 3/4 ln(4/3) = 0.34657 + 0.21576.
  const std::array unequal{ClassEvidence{kNeverNamed, Probability(0.25)},
                           ClassEvidence{kNamedThrice, Probability(0.75)}};
  EXPECT_NEAR(entropy_nats(unequal).value(), 0.56234, 1e-5);
}

TEST(ClassEntropy, OfNoClassThereIsNone) {
  EXPECT_FALSE(entropy_nats({}));
}

TEST(ObjectBeliefs, TellTheMostProbableClassFirstAndTheRunnerUpSecond) {
  // docs/EVALUATION.md, "Calibration". One view with five detections: (3 / root 5)^2 = 1.8 for the
  // sofa, (2 / root 5)^2 = 0.8 for the bench, 0.2 for the bed that nobody named; 2.8 in all.
  const ObjectBeliefs beliefs = object_beliefs(sofa_or_bench());
  ASSERT_EQ(beliefs.classes.size(), 3U);
  EXPECT_EQ(beliefs.classes[0].id, kNamedThrice);
  EXPECT_NEAR(beliefs.classes[0].probability.value(), 1.8 / 2.8, 1e-12);
  EXPECT_EQ(beliefs.classes[1].id, kNamedTwice);
  EXPECT_NEAR(beliefs.classes[1].probability.value(), 0.8 / 2.8, 1e-12);
  EXPECT_EQ(beliefs.classes[2].id, kNeverNamed);
  EXPECT_NEAR(beliefs.classes[2].probability.value(), 0.2 / 2.8, 1e-12);
  // 9/14 ln(14/9) + 4/14 ln(14/4) + 1/14 ln 14 = 0.28404 + 0.35793 + 0.18850.
  EXPECT_NEAR(beliefs.class_entropy_nats.value(), 0.83047, 1e-5);
}

TEST(ObjectBeliefs, AreWhatTheSingleQuestionsAnswer) {
  const Object object = sofa_or_bench();
  const ObjectBeliefs beliefs = object_beliefs(object);
  EXPECT_TRUE(std::ranges::is_permutation(beliefs.classes, class_distribution(object)));
  EXPECT_EQ(beliefs.classes.front(), best_class(object));
  EXPECT_EQ(beliefs.real, real_probability(object));
  EXPECT_EQ(beliefs.confidence, object_confidence(object));
}

TEST(ObjectBeliefs, OfEqualsTheMoreBelievedComesFirstThenTheLowerId) {
  Object object;
  object.belief =
      ClassBelief::from_entries(
          {},
          {{kNeverNamed, LogOdds(0.0)}, {kNamedThrice, LogOdds(0.0)}, {kNamedTwice, LogOdds(1.0)}})
          .value();
  for (const ClassId id : {kNamedTwice, kNamedThrice, kNeverNamed}) {
    object.observation_log.add({.class_id = id, .score = 0.7F, .distance_m = 2.0F});
  }
  const ObjectBeliefs beliefs = object_beliefs(object);
  std::vector<ClassId> ids;
  for (const ClassEvidence& c : beliefs.classes) ids.push_back(c.id);
  EXPECT_EQ(ids, (std::vector{kNamedTwice, kNeverNamed, kNamedThrice}));
  EXPECT_EQ(beliefs.classes.front(), best_class(object));
}

TEST(ObjectBeliefs, WithoutEvidenceOfAClassThereIsNoneAndNoConfidence) {
  Object object;
  object.existence = LogOdds(1.5);
  const ObjectBeliefs beliefs = object_beliefs(object);
  EXPECT_TRUE(beliefs.classes.empty());
  EXPECT_FALSE(beliefs.class_entropy_nats);
  EXPECT_EQ(beliefs.real, LogOdds(1.5).probability());
  EXPECT_EQ(beliefs.confidence, Probability(0.0));
}

TEST(ObjectBeliefs, LeaveOutWhatIsImpossible) {
  Object object;  // no detections recorded: the belief's shares, e^-2000 of one
  object.belief =
      ClassBelief::from_entries({.max_log_odds = LogOdds(1000.0), .min_log_odds = LogOdds(-1000.0)},
                                {{kNeverNamed, LogOdds(1000.0)}, {kNamedThrice, LogOdds(-1000.0)}})
          .value();
  const ObjectBeliefs beliefs = object_beliefs(object);
  ASSERT_EQ(beliefs.classes.size(), 1U);
  EXPECT_EQ(beliefs.classes[0], (ClassEvidence{kNeverNamed, Probability(1.0)}));
  EXPECT_EQ(beliefs.class_entropy_nats, 0.0);
}

}  // namespace
}  // namespace hypermap

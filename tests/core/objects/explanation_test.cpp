// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/explanation.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;
using testing_support::surface_of;

constexpr ClassId kNamedCup{1};
constexpr ClassId kNamedVase{2};

ObservationLogEntry detection(std::uint64_t frame, ClassId id, double bearing_rad, float score) {
  return {.frame_index = frame,
          .stamp = Stamp{static_cast<std::int64_t>(frame) * 100'000'000},
          .kind = ObservationKind::kDetection,
          .class_id = id,
          .score = score,
          .bearing_rad = static_cast<float>(bearing_rad)};
}

ObservationLogEntry missed(std::uint64_t frame, Visibility visibility, float visible_share) {
  return {.frame_index = frame,
          .stamp = Stamp{static_cast<std::int64_t>(frame) * 100'000'000},
          .kind = ObservationKind::kMissedDetection,
          .visibility = visibility,
          .class_id = kNamedCup,
          .score = visible_share,
          .effect = visibility == Visibility::kAbsent ? -1.0F : -0.2F};
}

/// A cup: five times from bearing 0, four from 90 degrees, of which one as a vase.
Object cup() {
  Object object = make_object(
      observed(surface_of(box_at({0, 0, 1}, {0.1, 0.1, 0.1})), scores(kNamedCup, 0.8)), {});
  object.observation_log = {};
  for (std::uint64_t frame = 0; frame < 5; ++frame) {
    object.observation_log.add(detection(frame, kNamedCup, 0.1, 0.5F));
  }
  for (std::uint64_t frame = 5; frame < 8; ++frame) {
    object.observation_log.add(detection(frame, kNamedCup, std::numbers::pi / 2, 0.9F));
  }
  object.observation_log.add(detection(8, kNamedVase, std::numbers::pi / 2, 0.4F));
  object.num_observations = 9;
  object.existence = LogOdds(5.0);
  return object;
}

Explanation explained(Object object, const ConfirmationOptions& options = {}) {
  ObjectMap map;
  const ObjectId id = map.add(std::move(object));
  return explain(map, id, options).value();
}

TEST(Explanation, CountsWhoNamedItWhatAndFromWhere) {
  const Explanation why = explained(cup());
  ASSERT_EQ(why.namings.size(), 2U);
  EXPECT_EQ(why.namings[0].class_id, kNamedCup);
  EXPECT_EQ(why.namings[0].num_detections, 8U);
  EXPECT_NEAR(why.namings[0].mean_score, (5 * 0.5 + 3 * 0.9) / 8.0, 1e-6);
  EXPECT_EQ(why.namings[0].num_directions, 2);
  EXPECT_EQ(why.namings[0].last_frame_index, 7U);
  EXPECT_EQ(why.namings[1].class_id, kNamedVase);
  EXPECT_EQ(why.namings[1].num_detections, 1U);
  EXPECT_EQ(why.directions, (std::vector<std::uint8_t>{0, 4})) << "20 degrees each";
  EXPECT_EQ(why.first->frame_index, 0U);
  EXPECT_EQ(why.newest->frame_index, 8U);
  EXPECT_TRUE(why.missed_conditions.empty());
}

TEST(Explanation, SumsUpWhatSpeaksAgainstIt) {
  Object object = cup();
  object.observation_log.add(missed(9, Visibility::kVisible, 0.9F));
  object.observation_log.add(missed(10, Visibility::kVisible, 0.5F));
  object.observation_log.add(missed(11, Visibility::kAbsent, 0.0F));
  const Explanation why = explained(object);
  EXPECT_EQ(why.missed_detections.num_frames, 3U);
  EXPECT_NEAR(why.missed_detections.mean_visible_share, 1.4 / 3.0, 1e-6);
  EXPECT_NEAR(why.missed_detections.existence_lost, 1.4, 1e-6);
}

TEST(Explanation, WhenItWasLastSeenIsTheNewestDetection) {
  Object object = cup();
  EXPECT_EQ(explained(object).last_seen->frame_index, 8U);
  object.observation_log.add(missed(9, Visibility::kVisible, 0.9F));
  const Explanation why = explained(object);
  EXPECT_EQ(why.newest->frame_index, 9U);
  EXPECT_EQ(why.last_seen->frame_index, 8U);
  EXPECT_EQ(why.last_seen->class_id, kNamedVase);
  EXPECT_EQ(why.last_seen_frame, 8U);
}

TEST(Explanation, OfADetectionThatIsNoLongerKeptTheFrameIsKnown) {
  Object object = cup();
  for (std::uint64_t frame = 9; frame < 9 + ObservationLog::kMaxNewest; ++frame) {
    object.observation_log.add(missed(frame, Visibility::kVisible, 0.9F));
  }
  const Explanation why = explained(object);
  EXPECT_FALSE(why.last_seen.has_value());
  EXPECT_EQ(why.last_seen_frame, 8U);
}

/// Whatever was detected how often: five looks over a second.
constexpr ConfirmationOptions kOneForAll{.gone = {.rare_looks = 0}};

TEST(Explanation, SaysWhatWouldRemoveIt) {
  Object object = cup();
  EXPECT_EQ(explained(object, kOneForAll).removal.looks_until_gone, 5U);
  // Existence 5, one less with each look, below -2 with the eighth.
  EXPECT_EQ(explained(object, kOneForAll).removal.looks_until_removed, 8U);
  object.observation_log.add(missed(9, Visibility::kAbsent, 0.0F));
  object.observation_log.add(missed(10, Visibility::kAbsent, 0.0F));
  EXPECT_EQ(explained(object, kOneForAll).removal.clear_looks.looks, 2U);
  EXPECT_EQ(explained(object, kOneForAll).removal.looks_until_gone, 3U);
  EXPECT_EQ(explained(object, kOneForAll).removal.seconds_until_gone, 1.0);
  EXPECT_EQ(explained(object, {.gone = {.looks = 0}}).removal.looks_until_gone, std::nullopt);
}

TEST(Explanation, OfWhatWasRarelyDetectedAsksForFewerLooksOverAnyTime) {
  Object object = cup();
  object.observation_log = {};
  for (std::uint64_t frame = 0; frame < 4; ++frame)
    object.observation_log.add(detection(frame, kNamedCup, 0.1, 0.5F));
  object.observation_log.add(missed(9, Visibility::kAbsent, 0.0F));
  EXPECT_EQ(explained(object).removal.looks_until_gone, 2U);
  EXPECT_EQ(explained(object).removal.seconds_until_gone, 0.0);
  for (std::uint64_t frame = 10; frame < 12; ++frame)
    object.observation_log.add(missed(frame, Visibility::kAbsent, 0.0F));
  EXPECT_EQ(explained(object).removal.looks_until_gone, 0U);
  ASSERT_FALSE(explained(object).missed_conditions.empty());
  EXPECT_EQ(explained(object).missed_conditions[0],
            (MissedCondition{.condition = Condition::kNotGone, .value = 3, .limit = 3}));
}

// [smap] 3.5.2: looks from sides on which it was never detected take a third.
TEST(Explanation, FromUnseenSidesMoreLooksRemoveIt) {
  // Existence 5, a third less with each look, below -2 with the 22nd (21 make 7 and no more).
  EXPECT_EQ(explained(cup()).removal.looks_until_removed_unseen, 22U);
  ObjectMap map;
  const ObjectId id = map.add(cup());
  const Explanation alike = explain(map, id, {}, {.unseen_side_factor = 1.0}).value();
  EXPECT_EQ(alike.removal.looks_until_removed_unseen, 8U);
  const Explanation never = explain(map, id, {}, {.unseen_side_factor = 0.0}).value();
  EXPECT_EQ(never.removal.looks_until_removed_unseen, std::nullopt);
}

// [smap] table D.2, o_valid: what falls below it leaves the map.
TEST(Explanation, ByRuleConfidenceTellsTheThreshold) {
  ObjectMap map;
  const ObjectId id = map.add(cup());
  AbsenceOptions absence;
  absence.removal = RemovalRule::kConfidence;
  absence.min_confidence = Probability(0.4);
  absence.confidence.rule = ConfidenceRule::kWeighted;
  const Explanation why = explain(map, id, {}, absence).value();
  ASSERT_TRUE(why.removal.threshold.has_value());
  EXPECT_EQ(why.removal.threshold->removed_below, Probability(0.4));
  EXPECT_EQ(why.removal.threshold->confidence, object_confidence(map.at(id), absence.confidence));
  EXPECT_EQ(why.removal.looks_until_removed, std::nullopt);
  EXPECT_FALSE(explain(map, id).value().removal.threshold.has_value());
}

TEST(Explanation, ItsConfidenceIsThatOfTheLayers) {
  ObjectMap map;
  const ObjectId id = map.add(cup());
  ConfirmationOptions confirmation;
  confirmation.confidence.rule = ConfidenceRule::kMultiplied;
  const Explanation why = explain(map, id, confirmation).value();
  EXPECT_EQ(why.confidence, object_confidence(map.at(id), confirmation.confidence));
  EXPECT_NE(why.confidence, explain(map, id).value().confidence);
}

// [smap] Eq. (3.17). Views: from the first bearing cup alone, sqrt 5; from the second cup 3 of 4
// and vase 1, 3/2 and 1/2. Weights 4 (sqrt 5 + 3/2)^2, 1/4 and 0.2 of all that were never named:
// cup is first, vase the runner-up.
TEST(Explanation, TellsWhatOutsideKnowledgeSaysOfTheClassAndTheRunnerUp) {
  Object object = cup();
  EXPECT_EQ(explained(object).prior, std::nullopt);
  object.prior =
      ClassPrior::create({{kNamedCup, LogOdds(std::log(4.0))}, {kNamedVase, LogOdds(-1e-16)}})
          .value();
  const Explanation why = explained(object);
  const double cup_weight = 4.0 * std::pow(std::sqrt(5.0) + 1.5, 2);
  EXPECT_NEAR(why.beliefs.classes[1].probability.value(), 0.25 / (cup_weight + 0.45), 1e-9);
  ASSERT_TRUE(why.prior.has_value());
  EXPECT_NEAR(why.prior->best, 4.0, 1e-12);
  EXPECT_NEAR(why.prior->runner_up, 1.0, 1e-12);
  EXPECT_FALSE(why.prior->is_of_each_observation);
}

TEST(Explanation, OfKnowledgeThatIsNoneOrOfOneClassItTellsNothing) {
  Object object = cup();
  object.prior =
      ClassPrior::create({{kNamedCup, LogOdds(-1e-16)}, {kNamedVase, LogOdds(2e-16)}}).value();
  EXPECT_EQ(explained(object).prior, std::nullopt) << "rounding";
  object.prior = ClassPrior::create({{kNamedCup, LogOdds(1.0)}}).value();
  EXPECT_TRUE(explained(object).prior.has_value());
  object.observation_log = {};
  object.observation_log.add(detection(0, kNamedCup, 0.1, 0.5F));
  object.belief = {};
  object.belief.observe(std::vector<ClassEvidence>{{kNamedCup, Probability(0.8)}},
                        Probability(0.5));
  EXPECT_EQ(explained(object).prior, std::nullopt) << "no other class is known of it";
}

TEST(Explanation, UnderTheSumThePriorIsThatOfTheNewestObservation) {
  Object object = cup();
  ClassBeliefOptions options;
  options.tempering = ClassTempering::kNone;
  object.belief = ClassBelief::create(options).value();
  object.belief.observe(
      std::vector<ClassEvidence>{{kNamedCup, Probability(0.8)}, {kNamedVase, Probability(0.2)}},
      Probability(0.5));
  object.prior = ClassPrior::create({{kNamedVase, LogOdds(-1.0)}}).value();
  const Explanation why = explained(object);
  ASSERT_TRUE(why.prior.has_value());
  EXPECT_TRUE(why.prior->is_of_each_observation);
  EXPECT_NEAR(why.prior->runner_up, std::exp(-1.0), 1e-12);
}

TEST(Explanation, OfWhatIsGoneSaysSo) {
  Object object = cup();
  for (std::uint64_t frame = 10; frame < 22; ++frame) {
    object.observation_log.add(missed(frame, Visibility::kAbsent, 0.0F));
  }
  const Explanation why = explained(object, kOneForAll);
  EXPECT_EQ(why.removal.looks_until_gone, 0U);
  ASSERT_FALSE(why.missed_conditions.empty());
  EXPECT_EQ(why.missed_conditions[0],
            (MissedCondition{.condition = Condition::kNotGone, .value = 12, .limit = 5}));
}

TEST(Explanation, OfManyFastLooksWaitsForTheTime) {
  Object object = cup();
  for (std::uint64_t frame = 10; frame < 16; ++frame) {  // six looks in half a second
    object.observation_log.add(missed(frame, Visibility::kAbsent, 0.0F));
  }
  EXPECT_EQ(explained(object, kOneForAll).removal.looks_until_gone, 1U);
}

TEST(Explanation, IsNoneOfAnObjectThatIsNotThere) {
  EXPECT_FALSE(explain(ObjectMap(), ObjectId{1}).has_value());
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/confirmation.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::observed;
using testing_support::scores;
using testing_support::surface_of;

constexpr ClassId kSeenCup{1};
constexpr ClassId kSeenOven{2};

/// From frame `first` on, once in each.
Object seen_times(const Box& box, ClassId id, int times, std::uint64_t first = 0) {
  Object object = make_object(observed(surface_of(box), scores(id, 0.8), first), {});
  for (int i = 1; i < times; ++i) {
    update_object(object, observed(surface_of(box), scores(id, 0.8), ++first), {});
  }
  return object;
}

TEST(Confirmation, ExistenceMustBeAboveTwo) {
  // [hypermap] 3.4.5: 1 + 1 = 2 is not above 2, 3 is.
  ObjectMap map;
  (void)map.add(seen_times(box_at({0, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 2));
  (void)map.add(seen_times(box_at({2, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 3));
  const ConfirmationOptions options{.min_existence = LogOdds(2.0), .min_observations = 1};
  EXPECT_EQ(confirmed_objects(map, options), std::vector{ObjectId{2}});
}

TEST(Confirmation, OfTwoOnTheSamePointsTheStrongerIsPublished) {
  ObjectMap map;
  const Box box = box_at({0, 0, 0.3}, {0.6, 0.6, 0.6});
  (void)map.add(seen_times(box, kSeenCup, 4));
  (void)map.add(seen_times(box, kSeenOven, 6, 100));
  EXPECT_EQ(confirmed_objects(map, {}), std::vector{ObjectId{2}});
  EXPECT_EQ(confirmed_objects(map, {.one_per_place = false}).size(), 2U);
}

TEST(Confirmation, TwoThatADetectorToldApartAreBothThere) {
  const Box box = box_at({0, 0, 0.3}, {0.6, 0.6, 0.6});
  const auto num_confirmed = [&](std::uint64_t first_of_weaker) {
    ObjectMap map;
    (void)map.add(seen_times(box, kSeenCup, 12));
    (void)map.add(seen_times(box, kSeenOven, 8, first_of_weaker));
    return confirmed_objects(map, {}).size();
  };
  EXPECT_EQ(num_confirmed(0), 2U) << "in all of its eight frames";
  EXPECT_EQ(num_confirmed(6), 2U) << "in six";
  EXPECT_EQ(num_confirmed(7), 1U) << "in five";
}

TEST(Confirmation, ThreeObservationsAreThree) {
  ObjectMap map;
  (void)map.add(seen_times(box_at({0, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 2));
  (void)map.add(seen_times(box_at({2, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 3));
  EXPECT_EQ(confirmed_objects(map, {}), std::vector{ObjectId{2}});
}

TEST(Confirmation, WhatIsSeenAndSeldomDetectedIsAFalseAlarm) {
  // Eight detections of one view and 20 frames that show it well without one.
  ObjectMap map;
  Object object = seen_times(box_at({0, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 8);
  for (int i = 0; i < 20; ++i) {
    object.observation_log.add({.frame_index = 8,
                                .kind = ObservationKind::kMissedDetection,
                                .visibility = Visibility::kVisible,
                                .class_id = kSeenCup,
                                .score = 0.8F});
  }
  (void)map.add(std::move(object));
  EXPECT_TRUE(confirmed_objects(map, {}).empty());
  EXPECT_EQ(confirmed_objects(map, {.min_real_probability = std::nullopt}).size(), 1U);
}

TEST(Confirmation, AProbabilityOfTwoThirdsIsNotEnough) {
  // Three detections of one view: -0.08 + 2.62 ln 3 - 2.18 ln(1 + m) is 1.29 for m = 1, so that
  // P(real) is 0.78, and 0.80 for m = 1.5, P(real) 0.69.
  for (const float last_visible_share : {0.0F, 0.5F}) {
    ObjectMap map;
    Object object = seen_times(box_at({0, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 3);
    for (const float visible_share : {1.0F, last_visible_share}) {
      object.observation_log.add({.frame_index = 8,
                                  .kind = ObservationKind::kMissedDetection,
                                  .visibility = Visibility::kVisible,
                                  .class_id = kSeenCup,
                                  .score = visible_share});
    }
    (void)map.add(std::move(object));
    EXPECT_EQ(confirmed_objects(map, {}).size(), last_visible_share == 0.0F ? 1U : 0U);
    EXPECT_EQ(confirmed_objects(map, {.min_real_probability = Probability(0.5)}).size(), 1U);
  }
}

TEST(Confirmation, WhatIsGoneIsNotConfirmedUntilItIsDetectedAgain) {
  ObjectMap map;
  const ObjectId id = map.add(seen_times(box_at({0, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 40));
  const auto num_confirmed = [&map] { return confirmed_objects(map, {}).size(); };
  for (int look = 1; look <= 5; ++look) {
    map.modify(id, [look](Object& object) {
      object.observation_log.add({.frame_index = 100,
                                  .stamp = Stamp{1'000'000'000LL * look},
                                  .kind = ObservationKind::kMissedDetection,
                                  .visibility = Visibility::kAbsent});
    });
    EXPECT_EQ(num_confirmed(), look < 5 ? 1U : 0U);
  }
  map.modify(id, [](Object& object) {
    const auto points = surface_of(object.box);
    update_object(object, observed(points, scores(kSeenCup, 0.8), 200), {});
  });
  EXPECT_EQ(num_confirmed(), 1U);
}

TEST(Confirmation, ASmallThingOnALargeOneIsPublished) {
  ObjectMap map;
  (void)map.add(seen_times(box_at({0, 0, 0.72}, {1.4, 0.8, 0.04}), kSeenOven, 4));
  (void)map.add(seen_times(box_at({0, 0, 0.79}, {0.08, 0.08, 0.1}), kSeenCup, 4));
  EXPECT_EQ(confirmed_objects(map, {}).size(), 2U);
}

TEST(Confirmation, TheConfidenceRuleAsksForTheConfidence) {
  // [smap] Eq. (3.27): seen once from 2.2 m: tp1 = 0.973, tp2 = 0.8, tp3 = 1 (nothing speaks
  // against it): (3.89 + 0.8 + 1) / 6 = 0.95.
  ObjectMap map;
  (void)map.add(seen_times(box_at({0, 0, 0}, {0.4, 0.4, 0.4}), kSeenCup, 1));
  ConfirmationOptions options{.min_real_probability = std::nullopt,
                              .min_confidence = Probability(0.94),
                              .confidence = {ConfidenceRule::kWeighted},
                              .min_observations = 1};
  EXPECT_EQ(confirmed_objects(map, options).size(), 1U);
  options.min_confidence = Probability(0.96);
  EXPECT_TRUE(confirmed_objects(map, options).empty());
}

TEST(Confirmation, BadOptionsAreNamed) {
  EXPECT_EQ(validate(ConfirmationOptions{.same_place_share = 2.0}).error().field,
            "same_place_share");
  EXPECT_TRUE(validate(ConfirmationOptions{}).has_value());
}

TEST(Confirmation, SaysWhichConditionsAnObjectMisses) {
  ObjectMap map;
  const Box box = box_at({0, 0, 0.3}, {0.6, 0.6, 0.6});
  (void)map.add(seen_times(box, kSeenCup, 4));
  (void)map.add(seen_times(box, kSeenOven, 6, 100));
  (void)map.add(seen_times(box_at({4, 0, 0.3}, {0.6, 0.6, 0.6}), kSeenCup, 2));
  const ConfirmationOptions options{.min_existence = LogOdds(2.0), .min_real_probability = {}};
  const auto results = confirmation_results(map, options);
  ASSERT_EQ(results.size(), 3U);
  EXPECT_EQ(
      results[0].missed,
      (std::vector{MissedCondition{.condition = Condition::kOwnPlace, .stronger = ObjectId{2}}}));
  EXPECT_TRUE(results[1].missed.empty());
  EXPECT_EQ(
      results[2].missed,
      (std::vector{MissedCondition{.condition = Condition::kObservations, .value = 2, .limit = 3},
                   MissedCondition{.condition = Condition::kExistence, .value = 2, .limit = 2}}));
}

}  // namespace
}  // namespace hypermap

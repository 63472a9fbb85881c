// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/association.hpp"

#include "core/objects/association_cases.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace hypermap {
namespace {

using testing_support::box_at;
using testing_support::kChairBox;
using testing_support::kChairClass;
using testing_support::kCupClass;
using testing_support::kFridge;
using testing_support::kOvenClass;
using testing_support::kTv;
using testing_support::observed;
using testing_support::only;
using testing_support::scores;
using testing_support::seen;
using testing_support::surface_of;
using testing_support::with;

TEST(Learning, ANewObjectHasWhatTheSourcesGiveIt) {
  // [hypermap] 3.4.5: existence 1. [smap] Eq. (3.18): ln(0.8/0.2) - ln(0.1/0.9) = 3.5835189 for
  // one of ten classes. [smap] Eq. (3.21): ln(0.8/0.2) = 1.3862944.
  const Object object = make_object(seen(kChairBox, kChairClass), {});
  EXPECT_DOUBLE_EQ(object.existence.value(), 1.0);
  EXPECT_NEAR(object.belief.log_odds(kChairClass).value(), 3.5835189, 1e-7);
  EXPECT_NEAR(object.box_confidence.value(), 1.3862944, 1e-7);
  EXPECT_EQ(object.num_observations, 1U);
  EXPECT_EQ(object.observation_log.state().first->class_id, kChairClass);
}

TEST(Learning, TheBoxFilterMovesLessTheMoreItKnows) {
  // [smap] Eq. (3.20), (3.21): after the second observation with confidence 0.8,
  // l_c = 2 ln 4 = 2.7725887, g = 1 / (1 + 16) = 0.0588235: x moves by 0.17 g = 0.01.
  AssociationOptions options;
  options.box_from_points = false;
  Object object = make_object(seen(kChairBox, kChairClass), options);
  EXPECT_NEAR(object.box.min_in_map.x(), -0.25, 1e-6);
  update_object(object, seen(box_at({0.17, 0, 0.45}, {0.5, 0.5, 0.9}), kChairClass, 1), options);
  EXPECT_NEAR(object.box.min_in_map.x(), -0.24, 1e-6);
  EXPECT_NEAR(object.centroid_in_map.x(), 0.01, 1e-6);
}

TEST(Learning, ACertainBoxDoesNotFreezeTheObject) {
  AssociationOptions options;
  options.box_from_points = false;
  Object object = make_object(seen(kChairBox, kChairClass), options);
  Observation moved = seen(box_at({1, 0, 0.45}, {0.5, 0.5, 0.9}), kChairClass);
  moved.segment.box_confidence = Probability(1.0);
  for (int i = 0; i < 200; ++i) update_object(object, moved, options);
  EXPECT_NEAR(object.centroid_in_map.x(), 1.0, 0.01);
}

TEST(Learning, ExistenceIsCapped) {
  Object object = make_object(seen(kChairBox, kChairClass), {});
  for (int i = 0; i < 50; ++i) update_object(object, seen(kChairBox, kChairClass), {});
  EXPECT_DOUBLE_EQ(object.existence.value(), 20.0);
}

TEST(UpdateObject, TheLogTellsWhatAnObservationTookFromTheOtherClasses) {
  // Of ten classes: 0.2 / 9 for each other one is logit(0.0222) - logit(0.1) = -3.784 + 2.197.
  constexpr float kTaken = -1.587F;
  const auto changed = [](ClassId id) { return BeliefChange{.class_id = id, .log_odds = kTaken}; };
  const auto others_of_newest = [](const Object& object) {
    const auto entries = object.observation_log.state().newest.back().other_changes.entries();
    return std::vector<BeliefChange>(entries.begin(), entries.end());
  };
  Object object = make_object(seen(kChairBox, kCupClass), {});
  EXPECT_EQ(
      others_of_newest(object),
      (std::vector{changed(kChairClass), changed(kOvenClass), changed(kFridge), changed(kTv)}));
  update_object(object, seen(kChairBox, kFridge, 1), {});
  EXPECT_EQ(
      others_of_newest(object),
      (std::vector{changed(kCupClass), changed(kChairClass), changed(kOvenClass), changed(kTv)}))
      << "the cup, which was believed most, comes first";
}

TEST(UpdateObject, TheClassesThatAVectorLeavesOutCount) {
  // [smap] Eq. (3.18), N = 10 of the combined set: logit(p) - logit(1/10), so that what is named
  // with 0.15 is likelier than what is not named at all. By the vector's own length, 3, it is not.
  Observation seen = observed(surface_of(box_at({0, 0, 0.2}, {0.4, 0.4, 0.4})),
                              {{ClassId{2}, Probability(0.7)},
                               {ClassId{4}, Probability(0.15)},
                               {ClassId{6}, Probability(0.15)}});
  EXPECT_LT(make_object(seen, {}).belief.log_odds(ClassId{4}), LogOdds{});
  seen.num_classes = 10;
  const Object object = make_object(seen, {});
  EXPECT_NEAR(object.belief.log_odds(ClassId{4}).value(),
              std::log(0.15 / 0.85) - std::log(0.1 / 0.9),
              1e-12);
  EXPECT_GT(object.belief.log_odds(ClassId{4}), LogOdds{});
}

TEST(Association, BearingIsThatOfTheCameraFromTheObject) {
  // [smap] figure 3.19.
  EXPECT_NEAR(bearing_from_object_rad({1, 1, 0}, {1, 3, 5}), M_PI / 2, 1e-12);
  EXPECT_DOUBLE_EQ(bearing_from_object_rad({1, 1, 0}, {1, 1, 5}), 0.0);
}

/// Each policy, one contract.
class EveryPolicy : public ::testing::TestWithParam<AssociationPolicy> {};

TEST_P(EveryPolicy, AThingSeenAgainIsOneObject) {
  ObjectMap map;
  for (std::uint64_t frame = 0; frame < 5; ++frame) {
    const auto report =
        associate(map, std::array{seen(kChairBox, kChairClass, frame)}, with(GetParam()));
    ASSERT_EQ(report.object_of_observation, std::vector{ObjectId{1}});
    EXPECT_EQ(report.created.size(), frame == 0 ? 1U : 0U);
    EXPECT_EQ(report.matched.size(), frame == 0 ? 0U : 1U);
  }
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(map.at(ObjectId{1}).num_observations, 5U);
}

TEST_P(EveryPolicy, ThingsFarApartAreTwoObjects) {
  ObjectMap map;
  const std::array both{seen(kChairBox, kChairClass),
                        seen(box_at({3, 0, 0.45}, {0.5, 0.5, 0.9}), kChairClass)};
  (void)associate(map, both, with(GetParam()));
  (void)associate(map, both, with(GetParam()));
  EXPECT_EQ(map.size(), 2U);
}

TEST_P(EveryPolicy, TransientClassesTouchNothing) {
  AssociationOptions options = with(GetParam());
  options.transient_classes = {kChairClass};
  ObjectMap map;
  const auto report = associate(map, std::array{seen(kChairBox, kChairClass)}, options);
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(report.num_transient, 1U);
  EXPECT_EQ(report.object_of_observation, std::vector{kNoObject});
}

TEST_P(EveryPolicy, NothingSeenChangesNothing) {
  ObjectMap map;
  const auto report = associate(map, {}, with(GetParam()));
  EXPECT_TRUE(map.empty());
  EXPECT_TRUE(report.object_of_observation.empty());
}

INSTANTIATE_TEST_SUITE_P(Policies,
                         EveryPolicy,
                         ::testing::Values(AssociationPolicy::kAssignment,
                                           AssociationPolicy::kOverlap,
                                           AssociationPolicy::kRadius,
                                           AssociationPolicy::kSmap));

TEST(AssignmentPolicy, ACabinetWithoutANameOfItsOwnIsOneObject) {
  // What a detector does that has no word for it: another one each time.
  const Box cabinet = box_at({1, 1, 0.3}, {0.8, 0.45, 0.6});
  ObjectMap map;
  std::uint64_t frame = 0;
  for (const ClassId id : {kOvenClass, kFridge, kTv, kOvenClass, kFridge, kOvenClass}) {
    (void)associate(map, std::array{seen(cabinet, id, frame++)}, {});
  }
  ASSERT_EQ(map.size(), 1U);
  EXPECT_EQ(best_class(*map.objects().begin())->id, kOvenClass);
}

TEST(AssignmentPolicy, CupsTenCentimetresApartStayTwo) {
  const Box left = box_at({0.0, 0, 0.8}, {0.08, 0.08, 0.1});
  const Box right = box_at({0.18, 0, 0.8}, {0.08, 0.08, 0.1});
  ObjectMap map;
  for (std::uint64_t frame = 0; frame < 10; ++frame) {
    if (frame % 3 == 1) {  // one is missed
      (void)associate(map, std::array{seen(right, kCupClass, frame)}, {});
    } else {
      (void)associate(
          map, std::array{seen(right, kCupClass, frame), seen(left, kCupClass, frame)}, {});
    }
  }
  EXPECT_EQ(map.size(), 2U);
}

TEST(AssignmentPolicy, ACupIsNoPartOfTheTableItStandsOn) {
  const Box table = box_at({0, 0, 0.72}, {1.4, 0.8, 0.04});
  const Box cup = box_at({0.2, 0.1, 0.79}, {0.08, 0.08, 0.1});
  ObjectMap map;
  for (std::uint64_t frame = 0; frame < 3; ++frame) {
    (void)associate(
        map, std::array{seen(table, kOvenClass, frame), seen(cup, kCupClass, frame)}, {});
  }
  EXPECT_EQ(map.size(), 2U);
}

TEST(AssignmentPolicy, FrontAndBackOfAThingAreOneObject) {
  const auto all = surface_of(kChairBox);
  const auto front = only(all, [](const auto& p) { return p.y() < -0.2F; });
  const auto back = only(all, [](const auto& p) { return p.y() > 0.2F; });
  const auto top = only(all, [](const auto& p) { return p.z() > 0.8F; });
  ObjectMap map;
  std::uint64_t frame = 0;
  for (const auto& part : {front, top, back, front, back}) {
    (void)associate(map, std::array{observed(part, scores(kChairClass, 0.8), frame++)}, {});
  }
  EXPECT_EQ(map.size(), 1U);
}

TEST(AssignmentPolicy, PartsThatGrowTogetherAreMerged) {
  const Box sofa = box_at({0, 0, 0.4}, {2.0, 0.9, 0.8});
  const auto all = surface_of(sofa);
  const auto left = only(all, [](const auto& p) { return p.x() < -0.3F; });
  const auto right = only(all, [](const auto& p) { return p.x() > 0.3F; });
  ObjectMap map;
  (void)associate(map, std::array{observed(left, scores(kChairClass, 0.8), 0)}, {});
  (void)associate(map, std::array{observed(right, scores(kChairClass, 0.8), 1)}, {});
  ASSERT_EQ(map.size(), 2U);
  for (std::uint64_t frame = 2; frame < 5; ++frame) {
    (void)associate(map, std::array{observed(all, scores(kChairClass, 0.8), frame)}, {});
  }
  EXPECT_EQ(map.size(), 1U);
}

TEST(AssignmentPolicy, TwoDetectionsOfOneThingInAFrameTeachOnce) {
  ObjectMap map;
  (void)associate(map, std::array{seen(kChairBox, kChairClass)}, {});
  const auto report =
      associate(map, std::array{seen(kChairBox, kChairClass, 1), seen(kChairBox, kTv, 1)}, {});
  EXPECT_EQ(map.size(), 1U);
  EXPECT_EQ(report.num_repeated, 1U);
  EXPECT_EQ(report.object_of_observation, (std::vector{ObjectId{1}, ObjectId{1}}));
  EXPECT_EQ(map.objects().begin()->num_observations, 2U);
}

TEST(AssignmentPolicy, TheOrderOfObservationsDoesNotMatter) {
  std::vector<Observation> frame;
  frame.reserve(6);
  for (int i = 0; i < 6; ++i) {
    frame.push_back(seen(box_at({0.3 * i, 0, 0.8}, {0.2, 0.2, 0.3}),
                         ClassId{static_cast<std::uint32_t>(i) % 2}));
  }
  ObjectMap forward;
  ObjectMap backward;
  (void)associate(forward, frame, {});
  (void)associate(forward, frame, {});
  std::reverse(frame.begin(), frame.end());
  (void)associate(backward, frame, {});
  (void)associate(backward, frame, {});
  ASSERT_EQ(forward.size(), 6U);
  ASSERT_EQ(backward.size(), 6U);
  for (std::uint32_t i = 1; i <= 6; ++i) {
    EXPECT_EQ(forward.at(ObjectId{i}).box, backward.at(ObjectId{7 - i}).box);
  }
}

TEST(AssociationOptions, BadValuesAreNamed) {
  EXPECT_TRUE(validate(AssociationOptions{}).has_value());
  EXPECT_EQ(validate(AssociationOptions{.min_jaccard = 2.0}).error().field, "min_jaccard");
  EXPECT_EQ(validate(AssociationOptions{.radius_m = static_cast<double>(NAN)}).error().field,
            "radius_m");
  EXPECT_EQ(validate(AssociationOptions{.max_box_confidence = 1.0}).error().field,
            "max_box_confidence");
  AssociationOptions options;
  options.assignment.near_m = 0.0;
  EXPECT_EQ(validate(options).error().field, "assignment.near_m");
}

}  // namespace
}  // namespace hypermap

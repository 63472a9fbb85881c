// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/place_prior.hpp"

#include "support/object_builders.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing_support::box_at;

/// Sofas are in living rooms, ovens in kitchens; chairs are anywhere.
PlaceRules sofa_rules() {
  PlaceRules rules;
  rules.belongings = {{"oven", {{"kitchen", 30.0}}}, {"sofa", {{"living room", 20.0}}}};
  rules.places = {"kitchen", "living room"};
  return rules;
}

class PlacePriorTest : public testing::Test {
 protected:
  PlacePriorTest() { places.observe({0, 0, 1}); }

  /// An object that a detector named so in each of so many views.
  ObjectId put(ClassId id, const Eigen::Vector3d& centre, unsigned num_views = 8) {
    Object object;
    object.box = box_at(centre, {0.4, 0.4, 0.4});
    object.centroid_in_map = centre;
    for (unsigned i = 0; i < num_views; ++i) {
      object.observation_log.add({.frame_index = i,
                                  .kind = ObservationKind::kDetection,
                                  .class_id = id,
                                  .score = 0.9F,
                                  .bearing_rad = 0.7F * static_cast<float>(i) - 3.0F});
    }
    object.belief.observe(std::vector<ClassEvidence>{{id, Probability(0.9)}}, Probability(0.5));
    object.num_observations = num_views;
    places.cover(centre);
    return objects.add(object);
  }

  /// Half chair, half sofa.
  [[nodiscard]] Observation doubtful_at(const Eigen::Vector3d& centre) const {
    Observation observation;
    observation.segment.centroid_in_map = centre;
    observation.segment.box = box_at(centre, {0.6, 0.6, 0.6});
    observation.class_scores = {{chair, Probability(0.5)}, {sofa, Probability(0.5)}};
    return observation;
  }

  [[nodiscard]] ClassPrior prior_of(const Observation& observation,
                                    double max_factor = 1000.0) const {
    return PlacePrior::create(sofa_rules(),
                              {.source = ClassPriorKind::kPlaces, .max_factor = max_factor})
        .value()
        .prior_of(observation, objects, places, classes);
  }

  ClassRegistry classes;
  const ClassId chair = classes.add("chair").value();
  const ClassId oven = classes.add("oven").value();
  const ClassId sofa = classes.add("couch").value();
  ObjectMap objects;
  TopologicalMap places;
};

TEST(BelongingFactor, IsTheExpectedWeightOverTheMean) {
  // [smap] Eq. (3.17), p(x): 3/4 living room: (0.25 * 1 + 0.75 * 20) / ((1 + 20) / 2).
  const PlaceBelief place{{"living room", 0.75}, {"kitchen", 0.25}};
  EXPECT_NEAR(belonging_factor(sofa_rules(), "sofa", place), 15.25 / 10.5, 1e-12);
  EXPECT_EQ(belonging_factor(sofa_rules(), "chair", place), 1.0);
  EXPECT_NEAR(
      belonging_factor(sofa_rules(), "sofa", {{"kitchen", 0.5}, {"living room", 0.5}}), 1.0, 1e-12);
}

TEST_F(PlacePriorTest, WhatStandsAroundTellsThePlace) {
  const ObjectId there = put(oven, {1, 0, 1});
  const double real = real_probability(objects.at(there)).value();
  // Naive Bayes of one oven: 30^sqrt(real) against 1.
  const double weight = std::pow(30.0, std::sqrt(real));
  const double kitchen = weight / (weight + 1.0);
  const ClassPrior prior = prior_of(doubtful_at({0.2, 0, 1}));
  EXPECT_NEAR(prior.factor(sofa), (kitchen + 20.0 * (1.0 - kitchen)) / 10.5, 1e-9);
  EXPECT_EQ(prior.factor(chair), 1.0);
  EXPECT_NEAR(prior_of(doubtful_at({0.2, 0, 1}), 3.0).factor(sofa), 1.0 / 3.0, 1e-12);
}

TEST_F(PlacePriorTest, OfAPlaceOfWhichNothingIsKnownItSaysNothing) {
  EXPECT_TRUE(prior_of(doubtful_at({0.2, 0, 1})).empty());
  put(chair, {1, 0, 1});
  EXPECT_TRUE(prior_of(doubtful_at({0.2, 0, 1})).empty()) << "chairs are anywhere";
  put(oven, {6, 0, 1});
  EXPECT_TRUE(prior_of(doubtful_at({0.2, 0, 1})).empty()) << "six edges away";
  put(oven, {0.8, 0.5, 1}, 1);
  EXPECT_TRUE(prior_of(doubtful_at({0.2, 0, 1})).empty()) << "seen once, it is hardly real";
}

// [smap] Eq. (3.17), p(x): of three places alike the first has 20 times as many ovens as the
// others: (20 + 1 + 1) / 3 through the mean (20 + 1 + 1) / 3 is 1, which doubles round to 1
// - 1.1e-16.
TEST_F(PlacePriorTest, RoundingIsNoKnowledge) {
  for (const double weight : {5.0, 7.0, 20.0, 25.0, 40.0, 50.0}) {
    PlaceRules rules;
    rules.places = {"kitchen", "living room", "office"};
    rules.belongings = {{"oven", {{"kitchen", weight}}}};
    const auto prior = PlacePrior::create(rules, {.source = ClassPriorKind::kPlaces}).value();
    const Observation observation = doubtful_at({0.2, 0, 1});
    EXPECT_TRUE(prior.prior_of(observation, objects, places, classes).empty()) << weight;
  }
}

TEST_F(PlacePriorTest, WhatIsAtHomeIsNotMoreProbableForThat) {
  put(sofa, {1.2, 0, 1});
  const ClassPrior prior = prior_of(doubtful_at({0.2, 0, 1}));
  EXPECT_LT(prior.factor(oven), 0.2) << "1 of a mean of 15.5 in a living room";
  EXPECT_EQ(prior.factor(sofa), 1.0);
  EXPECT_EQ(prior.factor(chair), 1.0);
}

// [smap] Eq. (3.17): p(x) is of the object, whose earlier observations named other classes than the
// newest one, which alone would leave them as they are.
TEST_F(PlacePriorTest, ItIsOfClassesThatTheObservationDoesNotName) {
  put(oven, {1, 0, 1});
  Observation observation = doubtful_at({0.2, 0, 1});
  const ClassPrior prior = prior_of(observation);
  observation.class_scores = {{chair, Probability(0.9)}};
  EXPECT_EQ(prior_of(observation), prior);
  EXPECT_LT(prior.factor(sofa), 0.2);
}

TEST_F(PlacePriorTest, AnObjectIsNoEvidenceForItself) {
  put(sofa, {0.3, 0, 1});
  EXPECT_TRUE(prior_of(doubtful_at({0.2, 0, 1})).empty());
}

TEST_F(PlacePriorTest, ANeighbourCountsWithoutItsOwnPrior) {
  const ObjectId there = put(oven, {1, 0, 1});
  const ClassPrior before = prior_of(doubtful_at({0.2, 0, 1}));
  objects.modify(there, [this](Object& object) {
    object.prior = ClassPrior::create({{oven, LogOdds(-2.0)}, {sofa, LogOdds(2.0)}}).value();
  });
  EXPECT_EQ(prior_of(doubtful_at({0.2, 0, 1})), before);
}

/// Cups are 6 to 16 cm high, bottles 16 to 40 cm.
PlaceRules sizes_of_vessels() {
  PlaceRules rules;
  rules.places = {"kitchen"};
  rules.sizes = {{"bottle", {.height = LengthRange{0.16, 0.40}}},
                 {"cup", {.height = LengthRange{0.06, 0.16}}}};
  return rules;
}

class SizePriorTest : public PlacePriorTest {
 protected:
  /// Of this height, seen from one side or from all around.
  ObjectId put_of_height(double height_m, unsigned num_views) {
    const ObjectId id = put(bottle, {0, 0, 1}, num_views);
    objects.modify(id, [&](Object& object) {
      object.box = box_at({0, 0, 1}, {0.1, 0.1, height_m});
    });
    return id;
  }
  /// Of an observation with a box of this size.
  [[nodiscard]] ClassPrior prior_at(const Eigen::Vector3d& centre,
                                    const Eigen::Vector3d& extent,
                                    double most = 1000.0) const {
    Observation observation = doubtful_at(centre);
    observation.segment.box = box_at(centre, extent);
    return PlacePrior::create(sizes_of_vessels(),
                              {.source = ClassPriorKind::kPlaces, .max_size_factor = most})
        .value()
        .prior_of(observation, objects, places, classes);
  }

  const ClassId bottle = classes.add("bottle").value();
  const ClassId cup = classes.add("cup").value();
};

// [smap] Eq. (3.17), p(x) of the size that the object has in the map.
TEST_F(SizePriorTest, WhatIsTooLargeForAClassIsHardlyOfIt) {
  put_of_height(0.35, 1);
  const ClassPrior prior = prior_at({0.01, 0, 1}, {0.1, 0.1, 0.3});
  EXPECT_NEAR(prior.factor(cup), std::exp(-4.8245), 1e-5) << "(0.35 - 0.03) / 0.16 is 2";
  EXPECT_EQ(prior.factor(bottle), 1.0);
  EXPECT_NEAR(prior_at({0.01, 0, 1}, {0.1, 0.1, 0.3}, 10.0).factor(cup), 0.1, 1e-12);
}

TEST_F(SizePriorTest, WhatIsTooSmallIsNotIfItWasSeenWhole) {
  const ObjectId seen_once = put_of_height(0.05, 1);
  EXPECT_TRUE(prior_at({0.01, 0, 1}, {0.1, 0.1, 0.05}).empty());
  objects.erase(seen_once);
  put_of_height(0.05, 8);
  const ClassPrior prior = prior_at({0.01, 0, 1}, {0.1, 0.1, 0.05});
  EXPECT_NEAR(prior.factor(bottle), std::exp(-4.8245), 1e-5) << "0.16 / (0.05 + 0.03) is 2";
  EXPECT_EQ(prior.factor(cup), 1.0);
}

TEST_F(SizePriorTest, WhatIsSeenFirstHasNoSizeYet) {
  EXPECT_TRUE(prior_at({0, 0, 1}, {0.1, 0.1, 0.35}).empty());
  put_of_height(0.35, 8);
  EXPECT_TRUE(prior_at({2, 0, 1}, {0.1, 0.1, 0.35}).empty()) << "another object";
}

TEST_F(SizePriorTest, WhatStandsInALargerOneHasNotItsSize) {
  const ObjectId desk = put_of_height(0.7, 8);
  objects.modify(desk, [](Object& object) { object.box = box_at({0, 0, 1}, {1.6, 1.0, 0.9}); });
  EXPECT_TRUE(prior_at({0.3, 0, 1}, {0.6, 0.6, 0.6}).empty()) << "0.15 of its volume";
}

TEST_F(SizePriorTest, OfSeveralObjectsTheBoxThatAgreesBestCounts) {
  const ObjectId tall = put_of_height(0.62, 8);  // which no bottle is
  objects.modify(tall, [](Object& object) { object.box = box_at({0, 0, 1}, {0.4, 0.4, 0.62}); });
  const ObjectId same = put(bottle, {0.05, 0, 1});
  objects.modify(same, [](Object& object) { object.box = box_at({0.05, 0, 1}, {0.6, 0.6, 0.3}); });
  const ClassPrior prior = prior_at({0.05, 0, 1}, {0.6, 0.6, 0.6});
  EXPECT_EQ(prior.factor(bottle), 1.0);
  EXPECT_LT(prior.factor(cup), 0.5);
}

TEST(PlacePrior, OptionsAndRulesAreChecked) {
  EXPECT_EQ(PlacePrior::create(sofa_rules(), {.max_size_factor = 0}).error().field,
            "max_size_factor");
  EXPECT_EQ(PlacePrior::create(sofa_rules(), {.max_factor = 0.5}).error().field, "max_factor");
  EXPECT_EQ(PlacePrior::create({}, {}).error().field, "places");
}

}  // namespace
}  // namespace hypermap

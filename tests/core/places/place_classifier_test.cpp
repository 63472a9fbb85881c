// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/places/place_classifier.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

PlaceRules home() {
  PlaceRules rules;
  rules.places = {"bedroom", "kitchen", "office"};
  rules.belongings = {{"oven", {{"kitchen", 9}}},
                      {"cup", {{"kitchen", 4}, {"office", 2}}},
                      {"bed", {{"bedroom", 16}}}};
  return rules;
}

BelongingsClassifier classifier(PlaceRules rules) {
  return BelongingsClassifier::create(std::move(rules)).value();
}

double probability_of(const PlaceBelief& belief, const std::string& place) {
  for (const PlaceProbability& one : belief) {
    if (one.place == place) return one.probability;
  }
  return std::nan("");
}

TEST(BelongingsClassifier, WeightsOfWhatIsThereMultiply) {
  // One oven and one cup: bedroom 1, kitchen 9 * 4 = 36, office 2; the sum is 39.
  const PlaceBelief belief = classifier(home()).classify({{"cup", 1.0}, {"oven", 1.0}});
  ASSERT_THAT(belief, SizeIs(3));
  EXPECT_EQ(belief[0].place, "kitchen");
  EXPECT_NEAR(belief[0].probability, 36.0 / 39.0, 1e-12);
  EXPECT_NEAR(belief[1].probability, 2.0 / 39.0, 1e-12);
  EXPECT_NEAR(belief[2].probability, 1.0 / 39.0, 1e-12);
}

TEST(BelongingsClassifier, FourCupsCountAsTwo) {
  // Tempered by 0.5: 4^2 = 16 for the kitchen, 2^2 = 4 for the office, 1; the sum is 21.
  const PlaceBelief belief = classifier(home()).classify({{"cup", 4.0}});
  EXPECT_NEAR(probability_of(belief, "kitchen"), 16.0 / 21.0, 1e-12);
  PlaceRules rules = home();
  rules.tempering = 1.0;
  const PlaceBelief untempered = classifier(rules).classify({{"cup", 4.0}});
  EXPECT_NEAR(probability_of(untempered, "kitchen"), 256.0 / (256.0 + 16.0 + 1.0), 1e-12);
}

TEST(BelongingsClassifier, WhatSaysNothingLeavesThePlaceUnknown) {
  const BelongingsClassifier of_home = classifier(home());
  for (const ClassAmounts& amounts :
       {ClassAmounts{}, ClassAmounts{{"person", 3.0}}, ClassAmounts{{"oven", 0.0}}}) {
    const PlaceBelief belief = of_home.classify(amounts);
    for (const PlaceProbability& one : belief) EXPECT_DOUBLE_EQ(one.probability, 1.0 / 3.0);
    EXPECT_EQ(of_home.decide(belief), std::nullopt);
  }
  PlaceRules bold = home();
  bold.min_probability = 0.0;
  EXPECT_EQ(classifier(bold).decide(classifier(bold).classify({})), std::nullopt) << "a tie";
  EXPECT_EQ(of_home.decide(of_home.classify({{"bed", 1.0}})), "bedroom");
  EXPECT_EQ(of_home.decide({}), std::nullopt);
}

TEST(BelongingsClassifier, AnUncertainObjectSaysLess) {
  const BelongingsClassifier of_home = classifier(home());
  const double sure = probability_of(of_home.classify({{"bed", 1.0}}), "bedroom");
  const double doubted = probability_of(of_home.classify({{"bed", 0.25}}), "bedroom");
  EXPECT_NEAR(sure, 16.0 / 18.0, 1e-12);
  EXPECT_NEAR(doubted, 4.0 / 6.0, 1e-12);  // 16^(0.25^0.5) = 4
}

TEST(ClassAmounts, AnObjectCountsAsItIsProbable) {
  ClassRegistry classes;
  const ClassId cup = classes.add("Dining Table").value();
  const ClassId bed = classes.add("bed").value();
  const std::vector<ObjectBeliefs> objects{
      {.classes = {{cup, Probability(0.75)}, {bed, Probability(0.25)}},
       .class_entropy_nats = {},
       .real = Probability(0.8),
       .confidence = Probability(0.6)},
      {.classes = {{bed, Probability(1.0)}},
       .class_entropy_nats = {},
       .real = Probability(0.5),
       .confidence = Probability(0.5)}};
  const ClassAmounts amounts = class_amounts(objects, classes);
  ASSERT_THAT(amounts, SizeIs(2));
  EXPECT_NEAR(amounts.at(canonical_class_name("diningtable")), 0.6, 1e-12);
  EXPECT_NEAR(amounts.at("bed"), 0.2 + 0.5, 1e-12);
}

TEST(PlaceRules, AreRefusedByField) {
  const auto field = [](auto change) {
    PlaceRules rules = home();
    change(rules);
    const auto ok = validate(rules);
    return ok ? std::string() : ok.error().field;
  };
  EXPECT_EQ(field([](PlaceRules&) {}), "");
  EXPECT_EQ(field([](PlaceRules& r) { r.places = {}; }), "places");
  EXPECT_EQ(field([](PlaceRules& r) { r.places = {"b", "a"}; }), "places");
  EXPECT_EQ(field([](PlaceRules& r) { r.tempering = 0; }), "tempering");
  EXPECT_EQ(field([](PlaceRules& r) { r.min_probability = 1.1; }), "min_probability");
  EXPECT_EQ(field([](PlaceRules& r) { r.belongings["oven"]["kitchen"] = 0; }),
            "belongings.oven.kitchen");
  EXPECT_EQ(field([](PlaceRules& r) { r.belongings["oven"]["cellar"] = 2; }), "belongings.oven");
  EXPECT_EQ(field([](PlaceRules& r) { r.belongings["Oven"]["kitchen"] = 2; }), "belongings.Oven");
  EXPECT_EQ(field([](PlaceRules& r) { r.metre_costs["kitchen"] = std::nan(""); }),
            "metre_costs.kitchen");
}

}  // namespace
}  // namespace hypermap

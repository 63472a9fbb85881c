// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/trained_combiner.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/core/segmentation/stacking.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr DetectorId kYolo{0};
constexpr DetectorId kSsd{1};

DetectorRegistry known_detectors_of_test() {
  DetectorRegistry registry;
  EXPECT_TRUE(registry.add({.name = "yolo"}));
  EXPECT_TRUE(registry.add({.name = "ssd"}));
  return registry;
}

/// Features: yolo speaks, its cup, its bowl; ssd speaks, its cup.
CombinerModel two_detectors() {
  return {.detectors = {{.name = "yolo", .classes = {"cup", "bowl"}},
                        {.name = "ssd", .classes = {"cup"}}},
          .classes = {{.class_name = "cup", .offset = -1.0, .weights = {0.0, 3.0, 0.0, 0.5, 3.0}},
                      {.class_name = "bowl", .offset = 0.0, .weights = {0.0, 0.0, 1.0, 0.0, 0.0}}}};
}

struct Bound {
  ClassRegistry classes;
  std::shared_ptr<const TrainedCombiner> combiner;
};

Bound bound_to_map(const CombinerModel& model) {
  Bound bound;
  EXPECT_TRUE(bound.classes.add("sofa"));
  const auto combiner = TrainedCombiner::bind(model, known_detectors_of_test(), bound.classes);
  EXPECT_TRUE(combiner) << to_string(combiner.error());
  if (combiner) bound.combiner = *combiner;
  return bound;
}

ClassEvidence said(const Bound& bound, const std::string& name, double p) {
  return {bound.classes.find(name).value(), Probability(p)};
}

// [smap] 3.5.3, one against all. A probability of 0.1 is 1 + log10(0.1) / 3 = 2 / 3, of 1 it is 1,
// of 0.001 and less 0.
TEST(CombinerFeatures, AFactorOfTenIsAThird) {
  const Bound bound = bound_to_map(two_detectors());
  ClassRegistry classes = bound.classes;
  const auto features =
      CombinerFeatures::bind(two_detectors().detectors, known_detectors_of_test(), classes);
  ASSERT_TRUE(features);
  const std::vector<std::vector<ClassEvidence>> words{
      {said(bound, "cup", 0.1), said(bound, "bowl", 0.0)}, {said(bound, "cup", 1.0)}};
  const std::vector<DetectorId> both{kYolo, kSsd};
  EXPECT_THAT(features->of(words, both),
              ElementsAre(1.0, DoubleNear(2.0 / 3.0, 1e-12), 0.0, 1.0, 1.0));
  const std::vector<DetectorId> one{kSsd};
  EXPECT_THAT(features->of(std::span(words).subspan(1), one), ElementsAre(0, 0, 0, 1, 1));
}

// [smap] 3.5.3: cup -1 + 3 * 2/3 + 0.5 + 3 * 1 = 4.5, p = 0.98901306; bowl 0 + 1 * 0 = 0, p = 0.5;
// all 1.48901306: 0.66420711 and 0.33579289.
TEST(TrainedCombiner, WeighsFeaturesForEachClassAgainstAllOthers) {
  const Bound bound = bound_to_map(two_detectors());
  const std::vector<std::vector<ClassEvidence>> words{
      {said(bound, "cup", 0.1), said(bound, "bowl", 0.0)}, {said(bound, "cup", 1.0)}};
  const std::vector<DetectorId> both{kYolo, kSsd};
  const auto combined = bound.combiner->combine(words, both);
  ASSERT_TRUE(combined);
  ASSERT_EQ(combined->size(), 2U);
  EXPECT_EQ((*combined)[0].id, bound.classes.find("cup"));
  EXPECT_NEAR((*combined)[0].probability.value(), 0.66420711, 1e-8);
  EXPECT_NEAR((*combined)[1].probability.value(), 0.33579289, 1e-8);
  const StackingModel model{.weights = {}, .combiner = bound.combiner};
  EXPECT_EQ(combine_class_scores(words, both, {.rule = StackingRule::kTrained}, model).value(),
            *combined);
  EXPECT_EQ(combine_class_scores(words, both, {.rule = StackingRule::kTrained}).error().field,
            "stacking.rule");
}

// Bowl has no rule: the mean 0.5 of the one that names it. Cup: -1 + 3 * 1 = 2, p = 0.88079708.
TEST(TrainedCombiner, HowCommonAClassWasIsTakenOut) {
  // Of four examples three were cups. yolo's bowl alone: cup 1 / (1 + e), 0.26894142, by a share of
  // 0.75; bowl 1 / (1 + 1 / e), 0.73105858, by one of 0.25; both times the mean share of 0.5.
  CombinerModel model = two_detectors();
  model.classes[0].share = 0.75;
  model.classes[1].share = 0.25;
  const Bound bound = bound_to_map(model);
  const std::vector<std::vector<ClassEvidence>> words{
      {said(bound, "cup", 0.0), said(bound, "bowl", 1.0)}};
  const std::vector<DetectorId> one{kYolo};
  const auto combined = bound.combiner->combine(words, one);
  ASSERT_TRUE(combined);
  const double cup = 0.26894142 * 0.5 / 0.75;
  const double bowl = 0.73105858 * 0.5 / 0.25;
  EXPECT_NEAR((*combined)[0].probability.value(), cup / (cup + bowl), 1e-8);
  EXPECT_NEAR((*combined)[1].probability.value(), bowl / (cup + bowl), 1e-8);
}

TEST(TrainedCombiner, AClassWithoutExamplesKeepsTheMean) {
  CombinerModel model = two_detectors();
  model.classes.pop_back();
  const Bound bound = bound_to_map(model);
  const std::vector<std::vector<ClassEvidence>> words{
      {said(bound, "cup", 1.0), said(bound, "bowl", 0.5)}};
  const std::vector<DetectorId> one{kYolo};
  const auto combined = bound.combiner->combine(words, one);
  ASSERT_TRUE(combined);
  EXPECT_NEAR((*combined)[1].probability.value(), 0.5 / 1.38079708, 1e-8);
}

TEST(TrainedCombiner, WhatItDoesNotKnowKeepsTheMean) {
  const Bound bound = bound_to_map(two_detectors());
  const std::vector<std::vector<ClassEvidence>> words{{said(bound, "sofa", 1.0)}};
  const std::vector<DetectorId> other{DetectorId{7}};
  EXPECT_EQ(bound.combiner->combine(words, other), words[0]);
  EXPECT_FALSE(bound.combiner->knows(DetectorId{7}));
  const std::vector<std::vector<ClassEvidence>> nothing{{}};
  EXPECT_EQ(bound.combiner->combine(nothing, other).error().code, ErrorCode::kInvalidArgument);
}

TEST(TrainedCombiner, OfNoneOfTheDetectorsIsRefused) {
  CombinerModel model = two_detectors();
  model.detectors[0].name = "a";
  model.detectors[1].name = "b";
  ClassRegistry classes;
  const auto refused = TrainedCombiner::bind(model, known_detectors_of_test(), classes);
  ASSERT_FALSE(refused);
  EXPECT_EQ(to_string(refused.error()),
            "combiner: knows none of the detectors; it was learnt of a, b");
}

TEST(CombinerModel, NamesTheBrokenField) {
  const auto broken = [](const auto& change) {
    CombinerModel model = two_detectors();
    change(model);
    const auto checked = validate(model);
    return checked ? "none" : checked.error().field;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(broken([](CombinerModel&) {}), "none");
  EXPECT_EQ(broken([](CombinerModel& m) { m.detectors.clear(); }), "detectors");
  EXPECT_EQ(broken([](CombinerModel& m) { m.detectors[1].name = "yolo"; }), "detectors[1]");
  EXPECT_EQ(broken([](CombinerModel& m) { m.detectors[0].classes[1] = "Cup"; }), "detectors[0]");
  EXPECT_EQ(broken([](CombinerModel& m) { m.classes.clear(); }), "classes");
  EXPECT_EQ(broken([](CombinerModel& m) { m.classes[1].class_name = "CUP"; }), "classes: names[1]");
  EXPECT_EQ(broken([](CombinerModel& m) { m.classes[1].weights.pop_back(); }),
            "classes[1].weights");
  EXPECT_EQ(broken([](CombinerModel& m) { m.classes[1].weights[2] = 2e6; }),
            "classes[1].weights[2]");
  EXPECT_EQ(broken([&](CombinerModel& m) { m.classes[0].offset = kNan; }), "classes[0].offset");
  EXPECT_EQ(broken([](CombinerModel& m) { m.classes[1].share = 0.0; }), "classes[1].share");
  EXPECT_EQ(broken([&](CombinerModel& m) { m.classes[0].share = kNan; }), "classes[0].share");
  EXPECT_EQ(broken([](CombinerModel& m) {
              for (int i = 0; i < 5000; ++i) m.detectors[1].classes.push_back(std::to_string(i));
            }),
            "detectors");
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/stacking.hpp"

#include "hypermap/core/segmentation/detector_registry.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <vector>

namespace hypermap {
namespace {

using Scores = std::vector<ClassEvidence>;

constexpr ClassId kA{0};
constexpr ClassId kB{1};
constexpr ClassId kC{2};
const std::vector<DetectorId> kTwoDetectors{{0}, {1}};

Scores scores(const std::map<ClassId, double>& values) {
  Scores out;
  for (const auto& [id, value] : values) out.push_back({id, Probability(value)});
  return out;
}

std::map<ClassId, double> combined(const std::vector<Scores>& likelihoods,
                                   const StackingOptions& options,
                                   const StackingModel& model = {}) {
  const Scores cells = combine_class_scores(likelihoods, kTwoDetectors, options, model).value();
  std::map<ClassId, double> out;
  for (const ClassEvidence& evidence : cells) {
    out[evidence.id] = evidence.probability.value();
  }
  return out;
}

const std::vector<Scores> kOneKnowsAbTheOtherBc{scores({{kA, 0.4}, {kB, 0.6}}),
                                                scores({{kB, 0.5}, {kC, 0.5}})};

// [smap] Eq. (3.14): {A, B} and {B, C} make the set {A, B, C}, B once.
// [smap] Eq. (3.15), Eq. (3.16), sum: A 0.4, B 0.6 + 0.5 = 1.1, C 0.5; all 2.0.
TEST(CombineClassScores, SumsSharedCells) {
  auto out = combined(kOneKnowsAbTheOtherBc, {.rule = StackingRule::kSum});
  EXPECT_EQ(out.size(), 3U);
  EXPECT_NEAR(out[kA], 0.20, 1e-12);
  EXPECT_NEAR(out[kB], 0.55, 1e-12);
  EXPECT_NEAR(out[kC], 0.25, 1e-12);
}

// [smap] Eq. (3.16), product: A 0.4, B 0.6 * 0.5 = 0.3, C 0.5; all 1.2.
TEST(CombineClassScores, MultipliesSharedCells) {
  auto out = combined(kOneKnowsAbTheOtherBc, {.rule = StackingRule::kProduct});
  EXPECT_NEAR(out[kA], 0.4 / 1.2, 1e-12);
  EXPECT_NEAR(out[kB], 0.3 / 1.2, 1e-12);
  EXPECT_NEAR(out[kC], 0.5 / 1.2, 1e-12);
}

DetectorRegistry yolo_and_ssd() {
  DetectorRegistry detectors;
  EXPECT_TRUE(detectors.add({.name = "yolo"}));
  EXPECT_TRUE(detectors.add({.name = "ssd"}));
  return detectors;
}

// [smap] Eq. (3.14), (3.15), (3.16), weights 3 and 1: A 1.2, B 1.8 + 0.5 = 2.3, C 0.5; all 4.0.
TEST(CombineClassScores, WeighsDetectorsByName) {
  const StackingOptions options{.rule = StackingRule::kWeighted, .weights = {{"yolo", 3.0}}};
  auto out = combined(kOneKnowsAbTheOtherBc, options, stacking_model(options, yolo_and_ssd()));
  EXPECT_NEAR(out[kA], 0.3, 1e-12);
  EXPECT_NEAR(out[kB], 2.3 / 4.0, 1e-12);
  EXPECT_NEAR(out[kC], 0.125, 1e-12);
}

// Two detectors of one mind, "a" of three and "b" of one class: with weights 2 and 6
// A 2 * 0.5 = 1, B 2 * 0.25 + 6 * 1 = 6.5, C 2 * 0.25 = 0.5; all 8.
TEST(CombineClassScores, AWeightMovesTheBalance) {
  const std::vector<Scores> likelihoods{scores({{kA, 0.5}, {kB, 0.25}, {kC, 0.25}}),
                                        scores({{kB, 1.0}})};
  const StackingOptions options{.rule = StackingRule::kWeighted,
                                .weights = {{"ssd", 6.0}, {"yolo", 2.0}}};
  auto out = combined(likelihoods, options, stacking_model(options, yolo_and_ssd()));
  EXPECT_NEAR(out[kA], 0.125, 1e-12);
  EXPECT_NEAR(out[kB], 0.8125, 1e-12);
  EXPECT_NEAR(out[kC], 0.0625, 1e-12);
}

TEST(CombineClassScores, WeightsCountByRuleWeightedAlone) {
  const StackingModel model{.weights = {{DetectorId{0}, 3.0}}};
  auto out = combined(kOneKnowsAbTheOtherBc, {.rule = StackingRule::kSum}, model);
  EXPECT_NEAR(out[kA], 0.20, 1e-12);
}

TEST(StackingModel, NamesOfNoDetectorAreSaid) {
  const StackingOptions options{.rule = StackingRule::kWeighted,
                                .weights = {{"yollo", 3.0}, {"ssd", 2.0}}};
  EXPECT_EQ(stacking_model(options, yolo_and_ssd()).weights,
            (std::map<DetectorId, double>{{DetectorId{1}, 2.0}}));
  const auto findings = check_weights(options, yolo_and_ssd());
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(to_string(findings[0].error),
            "stacking.weights: no detector is named \"yollo\", did you mean \"yolo\"? (there are: "
            "yolo, ssd)");
  EXPECT_TRUE(check_weights({}, yolo_and_ssd()).empty());
}

TEST(StackingModel, WeightsThatNoRuleTakesAreSaid) {
  const auto findings = check_weights({.weights = {{"ssd", 2.0}}}, yolo_and_ssd());
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(to_string(findings[0].error),
            "stacking.weights: has no effect unless stacking.rule is weighted");
}

TEST(CombineClassScores, FallsBackToTheSumWhenDetectorsContradictEachOther) {
  const std::vector<Scores> likelihoods{scores({{kA, 1.0}, {kB, 0.0}}),
                                        scores({{kA, 0.0}, {kB, 1.0}})};
  auto out = combined(likelihoods, {.rule = StackingRule::kProduct});
  EXPECT_NEAR(out[kA], 0.5, 1e-12);
  EXPECT_NEAR(out[kB], 0.5, 1e-12);
}

TEST(CombineClassScores, RefusesVectorsWithoutAnyEvidence) {
  const std::vector<Scores> nothing{scores({{kA, 0.0}}), {}};
  EXPECT_EQ(combine_class_scores(nothing, kTwoDetectors).error().code, ErrorCode::kInvalidArgument);
}

Detection detection(double u_min, double score, std::uint32_t detector) {
  return {.box_px = {u_min, 0, u_min + 10, 10},
          .class_scores = scores({{ClassId{detector}, 0.5}, {ClassId{9}, 0.5}}),
          .score = Probability(score),
          .detector = DetectorId{detector},
          .mask = {}};
}

// Overlap of [0, 10] and [1, 11]: 9 / 11 = 0.82. Mean edge (0.8 * 0 + 0.4 * 1) / 1.2 = 1/3.
TEST(StackDetections, JoinsTheSameThingSeenByTwoDetectors) {
  const std::vector<Detection> seen{detection(1, 0.4, 1), detection(0, 0.8, 0)};
  const auto joined = stack_detections(seen).value();
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_NEAR(joined[0].box_px.u_min_px, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(joined[0].score, Probability(0.8));
  EXPECT_EQ(joined[0].detector, DetectorId{0});
  EXPECT_EQ(joined[0].class_scores.size(), 3U);
  EXPECT_EQ(best_class(joined[0].class_scores)->id, ClassId{9});
}

// Together 0.6 + 0.1 for the one class, 0.4 + 0.9 for the other, which the second one named.
TEST(StackDetections, AreOfTheDetectorThatNamedTheirClass) {
  std::vector<Detection> seen{detection(0, 0.8, 0), detection(1, 0.4, 1)};
  seen[0].class_scores = scores({{ClassId{1}, 0.6}, {ClassId{2}, 0.4}});
  seen[1].class_scores = scores({{ClassId{1}, 0.1}, {ClassId{2}, 0.9}});
  const auto joined = stack_detections(seen).value();
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_EQ(best_class(joined[0].class_scores)->id, ClassId{2});
  EXPECT_EQ(joined[0].detector, DetectorId{1});
  EXPECT_EQ(joined[0].score, Probability(0.8));
}

TEST(StackDetections, KeepsApartWhatOneDetectorToldApart) {
  const std::vector<Detection> seen{detection(0, 0.8, 0), detection(1, 0.7, 0)};
  EXPECT_EQ(stack_detections(seen).value(), seen);
}

TEST(StackDetections, KeepsApartWhatOverlapsTooLittle) {
  const std::vector<Detection> seen{detection(0, 0.8, 0), detection(6, 0.7, 1)};
  EXPECT_EQ(stack_detections(seen).value().size(), 2U);
}

TEST(StackDetections, UnitesMasks) {
  std::vector<Detection> seen{detection(0, 0.8, 0), detection(1, 0.7, 1)};
  seen[0].mask = MaskImage(2, 1);
  seen[1].mask = MaskImage(2, 1);
  seen[0].mask->at(0, 0) = 1;
  seen[1].mask->at(1, 0) = 1;
  const auto joined = stack_detections(seen).value();
  EXPECT_EQ(joined.at(0).mask, MaskImage(2, 1, 1));
}

TEST(StackDetections, KeepsOfEachModelTheEmbeddingOfTheBestScore) {
  std::vector<Detection> seen{detection(0, 0.7, 0), detection(1, 0.8, 1)};
  seen[0].embeddings = {{"a", {1, 0}}, {"b", {0, 1}}};
  seen[1].embeddings = {{"b", {1, 1}}};
  const std::vector<Embedding> expected{{"b", {1, 1}}, {"a", {1, 0}}};
  EXPECT_EQ(stack_detections(seen).value().at(0).embeddings, expected);
}

TEST(StackDetections, NamesTheDetectionWithoutEvidence) {
  std::vector<Detection> seen{detection(0, 0.8, 0), detection(50, 0.7, 0)};
  seen[1].class_scores.clear();
  EXPECT_EQ(stack_detections(seen).error().entry, "detection 1");
}

TEST(StackingRules, NameTheBrokenField) {
  EXPECT_EQ(validate(StackingOptions{.min_overlap = 0.0}).error().field, "min_overlap");
  const Error negative = validate(StackingOptions{.weights = {{"ssd", -1.0}}}).error();
  EXPECT_EQ(to_string(negative),
            "weights: each must be in 0.000001 .. 1000000, that of \"ssd\" is -1");
  EXPECT_EQ(validate(StackingOptions{.weights = {{"ssd", 1.0}, {"ssd", 1.0}}}).error().what,
            "must name each once, \"ssd\" is there twice");
  EXPECT_TRUE(validate(StackingOptions{}).has_value());
}

}  // namespace
}  // namespace hypermap

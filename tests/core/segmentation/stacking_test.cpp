// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/stacking.hpp"

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
                                   const StackingOptions& options) {
  const Scores cells = combine_class_scores(likelihoods, kTwoDetectors, options).value();
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

// [smap] Eq. (3.16), weights 3 and 1: A 1.2, B 1.8 + 0.5 = 2.3, C 0.5; all 4.0.
TEST(CombineClassScores, WeighsDetectors) {
  auto out = combined(kOneKnowsAbTheOtherBc,
                      {.rule = StackingRule::kWeighted, .weights = {{DetectorId{0}, 3.0}}});
  EXPECT_NEAR(out[kA], 0.3, 1e-12);
  EXPECT_NEAR(out[kB], 2.3 / 4.0, 1e-12);
  EXPECT_NEAR(out[kC], 0.125, 1e-12);
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
  EXPECT_EQ(validate(StackingOptions{.weights = {{DetectorId{2}, -1.0}}}).error().field,
            "weights[2]");
  EXPECT_TRUE(validate(StackingOptions{}).has_value());
}

}  // namespace
}  // namespace hypermap

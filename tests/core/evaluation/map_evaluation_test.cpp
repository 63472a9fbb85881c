// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/map_evaluation.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

EvaluatedObject evaluated_object(const std::string& name, double x, double y, double side = 0.5) {
  const double h = side / 2.0;
  EvaluatedObject out;
  out.class_name = name;
  out.centroid = {x, y};
  out.footprint =
      make_polygon({{x - h, y - h}, {x + h, y - h}, {x + h, y + h}, {x - h, y + h}}).value();
  return out;
}

TEST(Evaluation, ByHand) {
  // Two chairs, one found 0.1 m aside; a table that nobody found; a sofa that is not there.
  // Precision 1/2, recall 1/3, F1 = 2 * 1 / (2 + 3) = 0.4. In place the found chair shares
  // 0.4 * 0.5 = 0.2 of 0.5 - 0.2 = 0.3: 2/3, the mean over three truths is 2/9.
  const std::vector truth{evaluated_object("chair", 0, 0),
                          evaluated_object("chair", 5, 0),
                          evaluated_object("table", 0, 5)};
  const std::vector map{evaluated_object("chair", 0.1, 0), evaluated_object("sofa", 9, 9)};
  const auto report = evaluate(map, truth);
  const OneToOneMetric& all = report.all.one_to_one;
  EXPECT_DOUBLE_EQ(*all.precision, 0.5);
  EXPECT_NEAR(*all.recall, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(*all.f1, 0.4, 1e-12);
  EXPECT_NEAR(*all.distance_m, 0.1, 1e-12);
  EXPECT_NEAR(*all.jaccard_in_place, 2.0 / 9.0, 1e-9);
  EXPECT_EQ(report.false_positives, std::vector<std::size_t>{1});
  EXPECT_EQ(report.classes.at("chair").one_to_one.matched, 1U);
  EXPECT_FALSE(report.classes.at("table").one_to_one.precision.has_value());
}

TEST(Evaluation, TheTextsMetricLetsOneMapObjectServeSeveralTruths) {
  // [hypermap] 5.2.1: distances 0.1 and 4.9, both shapes equal after alignment; the table's class
  // is not in the map and does not count.
  const std::vector truth{evaluated_object("chair", 0, 0),
                          evaluated_object("chair", 5, 0),
                          evaluated_object("cup", 0, 5)};
  const std::vector map{evaluated_object("chair", 0.1, 0)};
  const NearestMetric& metric = evaluate(map, truth).all.nearest;
  EXPECT_EQ(metric.n, 2U);
  EXPECT_EQ(metric.num_truth, 3U);
  EXPECT_NEAR(*metric.distance_m, 2.5, 1e-12);
  EXPECT_NEAR(*metric.jaccard, 1.0, 1e-9);
}

TEST(Evaluation, GatesDependOnTheSizeOfTheTruth) {
  // docs/EVALUATION.md: 0.5 m, 0.25 m for truths under 30 cm; the gate itself matches.
  const auto matched = [](double side, double distance) {
    return evaluate(std::vector{evaluated_object("cup", distance, 0, side)},
                    std::vector{evaluated_object("cup", 0, 0, side)})
        .all.one_to_one.matched;
  };
  EXPECT_EQ(matched(0.4, 0.5), 1U);
  EXPECT_EQ(matched(0.4, 0.51), 0U);
  EXPECT_EQ(matched(0.1, 0.25), 1U);
  EXPECT_EQ(matched(0.1, 0.26), 0U);
  EXPECT_EQ(matched(0.3, 0.4), 1U);
}

TEST(Evaluation, AThingThatIsThereTwiceIsADuplicate) {
  const auto report =
      evaluate(std::vector{evaluated_object("chair", 0.1, 0), evaluated_object("chair", -0.2, 0)},
               std::vector{evaluated_object("chair", 0, 0)});
  EXPECT_EQ(report.all.one_to_one.duplicates, 1U);
  EXPECT_EQ(report.duplicates, std::vector<std::size_t>{1});
  EXPECT_EQ(report.false_positives, std::vector<std::size_t>{1});
}

TEST(Evaluation, DuplicatesLieWithinHalfTheLongestSideToo) {
  // A sofa of 2 m by 0.5 m: half its longest side is 1 m, the gate 0.5 m.
  EvaluatedObject sofa = evaluated_object("sofa", 0, 0);
  sofa.footprint = make_polygon({{-1, -0.25}, {1, -0.25}, {1, 0.25}, {-1, 0.25}}).value();
  const auto duplicates = [&](double first, double second) {
    return evaluate(
               std::vector{evaluated_object("sofa", first, 0), evaluated_object("sofa", second, 0)},
               std::vector{sofa})
        .duplicates;
  };
  EXPECT_EQ(duplicates(0.1, 1.0), std::vector<std::size_t>{1});
  EXPECT_EQ(duplicates(-1.0, 0.1), std::vector<std::size_t>{0});
  EXPECT_TRUE(duplicates(0.1, 1.01).empty());
  // Neither matches: the nearer one is the first, the other its duplicate.
  EXPECT_EQ(duplicates(0.9, -0.8), std::vector<std::size_t>{0});
  EXPECT_TRUE(duplicates(0.9, 1.2).empty());
}

TEST(Evaluation, BoxesOfMatchesShareTheirVolume) {
  // 1 m cubes 0.5 m apart along x: 0.5 of 1.5 is 1/3. A match without a box does not count.
  std::vector truth{evaluated_object("chair", 0, 0), evaluated_object("chair", 5, 0)};
  std::vector map{evaluated_object("chair", 0.1, 0), evaluated_object("chair", 5, 0)};
  truth[0].box = {{0, 0, 0}, {1, 1, 1}};
  truth[1].box = truth[0].box;
  map[0].box = {{0.5, 0, 0}, {1.5, 1, 1}};
  const auto report = evaluate(map, truth);
  EXPECT_NEAR(*report.all.one_to_one.box_iou, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(report.all.one_to_one.num_boxes, 1U);
  EXPECT_NEAR(*report.truths[0].box_iou, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(*report.classes.at("chair").one_to_one.box_iou, 1.0 / 3.0, 1e-12);
  EXPECT_FALSE(report.truths[1].box_iou);
}

TEST(Evaluation, CoverageAndTheJaccardOfWhatWasSeen) {
  // Squares of 0.5 m. The first is covered to 0.4 / 0.5, its Jaccard index is 0.4 / 0.6 = 2/3; the
  // second is missed; the third is whole. Half of the first was seen, less of the second, and
  // nothing is known of the third.
  std::vector truth{evaluated_object("chair", 0, 0),
                    evaluated_object("chair", 5, 0),
                    evaluated_object("chair", 9, 0)};
  truth[0].seen_footprint_share = 0.5;
  truth[1].seen_footprint_share = 0.49;
  const auto report = evaluate(
      std::vector{evaluated_object("chair", 0.1, 0), evaluated_object("chair", 9, 0)}, truth);
  const OneToOneMetric& all = report.all.one_to_one;
  EXPECT_NEAR(report.truths[0].footprint_covered, 0.8, 1e-9);
  EXPECT_NEAR(*all.footprint_covered, 0.6, 1e-9);
  EXPECT_NEAR(*all.jaccard_in_place, 5.0 / 9.0, 1e-9);
  EXPECT_NEAR(*all.seen_jaccard_in_place, 2.0 / 3.0, 1e-9);
  EXPECT_EQ(all.num_seen, 1U);
  EXPECT_EQ(*all.worst_jaccard_in_place, 0.0);
}

TEST(Evaluation, RarelySeenTruthsAreExcludedOnesThatCanBeNamed) {
  std::vector truth{evaluated_object("chair", 0, 0), evaluated_object("bin", 5, 0)};
  for (EvaluatedObject& object : truth) object.excluded = true;
  truth[1].is_nameable = false;
  const auto report = evaluate({}, truth);
  EXPECT_EQ(report.all.one_to_one.excluded, 2U);
  EXPECT_EQ(report.all.one_to_one.rarely_seen, 1U);
}

TEST(Evaluation, ExcludedTruthsAreNeitherRightNorWrong) {
  EvaluatedObject hidden = evaluated_object("chair", 0, 0);
  hidden.excluded = true;
  const auto report = evaluate(std::vector{evaluated_object("chair", 0.1, 0)},
                               std::vector{hidden, evaluated_object("cup", 3, 3, 0.1)});
  EXPECT_EQ(report.all.one_to_one.excluded, 1U);
  EXPECT_EQ(report.all.one_to_one.num_map, 0U);
  EXPECT_EQ(report.all.one_to_one.num_truth, 1U);
  EXPECT_FALSE(report.all.one_to_one.precision.has_value());
  EXPECT_DOUBLE_EQ(*report.all.one_to_one.recall, 0.0);
}

TEST(Evaluation, OtherSpellingsAreTheSameClass) {
  const auto report =
      evaluate(std::vector{evaluated_object("couch", 0, 0), evaluated_object("tv", 3, 0)},
               std::vector{evaluated_object("sofa", 0, 0), evaluated_object("tvmonitor", 3, 0)});
  EXPECT_EQ(report.all.one_to_one.matched, 2U);
}

TEST(Evaluation, TheAssignmentIsTheBestOneNotTheFirst) {
  // Greedily the first chair would take the truth at 0 (0.2 away) and leave the second without.
  const auto report =
      evaluate(std::vector{evaluated_object("chair", 0.2, 0), evaluated_object("chair", -0.3, 0)},
               std::vector{evaluated_object("chair", 0, 0), evaluated_object("chair", 0.6, 0)});
  EXPECT_EQ(report.all.one_to_one.matched, 2U);
}

TEST(Evaluation, SmallFootprintsAreJudgedApart) {
  const auto report =
      evaluate(std::vector{evaluated_object("cup", 0, 0, 0.1), evaluated_object("chair", 2, 0)},
               std::vector{evaluated_object("cup", 0, 0, 0.1), evaluated_object("chair", 2, 0)});
  EXPECT_EQ(report.all.one_to_one.num_judged, 1U);
  EXPECT_EQ(report.all.one_to_one.num_small, 1U);
}

TEST(Evaluation, OnlyChosenClassesCount) {
  EvaluationOptions options;
  options.classes = {"Couch"};
  const auto report =
      evaluate(std::vector{evaluated_object("sofa", 0, 0), evaluated_object("cup", 1, 0)},
               std::vector{evaluated_object("sofa", 0, 0), evaluated_object("cup", 1, 0)},
               options);
  EXPECT_EQ(report.all.one_to_one.num_truth, 1U);
  EXPECT_EQ(report.classes.size(), 1U);
}

TEST(Evaluation, NothingAgainstNothingIsNothing) {
  const auto report = evaluate({}, {});
  EXPECT_FALSE(report.all.one_to_one.f1.has_value());
  EXPECT_FALSE(report.all.nearest.distance_m.has_value());
  EXPECT_EQ(validate(EvaluationOptions{.gate_m = 0.0}).error().field, "gate_m");
}

TEST(Evaluation, OptionsOutOfTheirRangeAreNamed) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto refusal = [](const EvaluationOptions& options) {
    const auto checked = validate(options);
    return checked ? "none" : to_string(checked.error());
  };
  EXPECT_EQ(refusal({}), "none");
  EXPECT_EQ(refusal({.gate_m = 0.0}), "gate_m: must be above 0 and finite, is 0");
  EXPECT_EQ(refusal({.small_gate_m = kInfinity}),
            "small_gate_m: must be above 0 and finite, is inf");
  EXPECT_EQ(refusal({.small_size_m = -0.5}), "small_size_m: must be above 0 and finite, is -0.5");
  EXPECT_EQ(refusal({.min_judged_area_m2 = 0.0}), "none");
  EXPECT_EQ(refusal({.min_judged_area_m2 = -1.0}),
            "min_judged_area_m2: must be at least 0 and finite, is -1");
  EXPECT_EQ(refusal({.min_seen_share = 1.5}), "min_seen_share: must be in 0 .. 1, is 1.5");
}

}  // namespace
}  // namespace hypermap

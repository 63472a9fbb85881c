// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/run_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hypermap {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

/// A truth that was found `error_m` off, or missed.
TruthRun tabled_truth(const std::string& reference, const std::optional<Eigen::Vector3d>& error_m) {
  TruthRun truth{.reference = reference, .class_name = "tv", .error_m = error_m};
  if (error_m) truth.object_id = 1;
  return truth;
}

/// A run whose only class is tv.
RunRates tv_run(std::vector<TruthRun> truths, std::size_t num_false = 0) {
  RunRates run{.truths = std::move(truths)};
  ClassRun& tvs = run.classes["tv"];
  tvs.counts.false_positives = num_false;
  for (const TruthRun& truth : run.truths) {
    if (!truth.counts) continue;
    ++(truth.object_id ? tvs.counts.true_positives : tvs.counts.false_negatives);
    if (truth.error_m) tvs.errors_m.push_back(*truth.error_m);
  }
  for (auto& ranked : tvs.ranked) {
    ranked.assign(tvs.counts.true_positives, {0.9, true});
    ranked.insert(ranked.end(), num_false, {0.5, false});
  }
  return run;
}

const RunFigure& figure_of(const RunTables& tables, const std::string& key) {
  return *std::find_if(tables.figures.begin(), tables.figures.end(), [&](const RunFigure& figure) {
    return figure.key == key;
  });
}

// [smap] tables 5.2, E.1.1 to E.1.3: object 6, a television, found in all three runs.
TEST(RunTables, AnObjectsErrorIsTheMeanOverItsRuns) {
  const std::vector<RunRates> runs{tv_run({tabled_truth("6", Eigen::Vector3d(0.11, -0.10, 0.09))}),
                                   tv_run({tabled_truth("6", Eigen::Vector3d(0.01, -0.20, 0.09))}),
                                   tv_run({tabled_truth("6", Eigen::Vector3d(-0.09, -0.10, -0.01)),
                                           tabled_truth("5", std::nullopt)})};
  const RunTables tables = run_tables(runs);
  ASSERT_THAT(tables.objects, SizeIs(2));
  const ObjectRow& sixth = tables.objects[0];
  EXPECT_EQ(sixth.reference, "6");
  EXPECT_EQ(sixth.num_counting, 3U);
  EXPECT_EQ(sixth.num_found, 3U);
  EXPECT_TRUE(sixth.position.mean_m->isApprox(Eigen::Vector3d(0.01, -0.4 / 3.0, 0.17 / 3.0)));
  EXPECT_EQ(tables.objects[1].num_counting, 1U);
  EXPECT_EQ(tables.objects[1].num_found, 0U);
  EXPECT_FALSE(tables.objects[1].position.mean_m);
  // One object has a mean error, so its length is the error of all.
  EXPECT_EQ(tables.mean_errors.n, 1U);
  EXPECT_DOUBLE_EQ(*tables.mean_errors.total_rmse_m, sixth.position.mean_m->norm());
}

TEST(RunTables, FiguresHaveMeanAndDeviationOverRuns) {
  // Precision 1 and 1/2: mean 3/4, deviation 1/4 sqrt 2.
  const std::vector<RunRates> runs{tv_run({tabled_truth("1", Eigen::Vector3d::Zero())}),
                                   tv_run({tabled_truth("1", Eigen::Vector3d::Zero())}, 1)};
  const RunTables tables = run_tables(runs);
  EXPECT_EQ(figure_of(tables, "precision").over_runs.n, 2U);
  EXPECT_DOUBLE_EQ(*figure_of(tables, "precision").over_runs.mean, 0.75);
  EXPECT_DOUBLE_EQ(*figure_of(tables, "precision").over_runs.std, std::sqrt(0.125));
  EXPECT_EQ(tables.all.counts.true_positives, 2U);
  EXPECT_EQ(tables.all.counts.false_positives, 1U);
  EXPECT_DOUBLE_EQ(*tables.all.average_precision[0], 1.0);
  const OverRuns alone = figure_of(run_tables(std::span(runs).first(1)), "precision").over_runs;
  EXPECT_EQ(alone.mean, 1.0);
  EXPECT_FALSE(alone.std);
  EXPECT_FALSE(alone.half_width_95);
  EXPECT_FALSE(alone.low_95());
  EXPECT_FALSE(alone.high_95());
}

TEST(RunTables, AMeanHasItsIntervalOverTheRunsThatHaveTheFigure) {
  // Indices 0.5 and 1: t = 12.7062 of one degree of freedom, times 0.25. F1 of them 1 and 2/3.
  std::vector<RunRates> runs{tv_run({tabled_truth("1", Eigen::Vector3d::Zero())}),
                             tv_run({tabled_truth("1", Eigen::Vector3d::Zero())}, 1),
                             tv_run({})};
  runs[0].fit = {.jaccard_in_place = 0.5, .label_precision = 0.9};
  runs[1].fit = {.jaccard_in_place = 1.0};
  const RunTables tables = run_tables(runs);
  const OverRuns jaccard = figure_of(tables, "jaccard_in_place").over_runs;
  EXPECT_EQ(jaccard.n, 2U);
  EXPECT_DOUBLE_EQ(*jaccard.mean, 0.75);
  EXPECT_NEAR(*jaccard.half_width_95, 3.17655, 1e-5);
  EXPECT_NEAR(*jaccard.low_95(), -2.42655, 1e-5);
  EXPECT_NEAR(*jaccard.high_95(), 3.92655, 1e-5);
  EXPECT_DOUBLE_EQ(*figure_of(tables, "f1").over_runs.mean, 5.0 / 6.0);
  const OverRuns labels = figure_of(tables, "label_precision").over_runs;
  EXPECT_EQ(labels.n, 1U);
  EXPECT_FALSE(labels.half_width_95);
  EXPECT_EQ(figure_of(tables, "label_recall").over_runs.n, 0U);
  EXPECT_EQ(tables.run_fits[1], runs[1].fit);
}

// [smap] Eq. (B.9): AP 1 and 1/2; a class without truths has none.
TEST(RunTables, MeanAveragePrecisionIsOverClassesWithTruths) {
  RunRates run = tv_run({tabled_truth("1", Eigen::Vector3d::Zero())});
  ClassRun& cups = run.classes["cup"];
  cups.counts.true_positives = 1;
  cups.counts.false_negatives = 1;
  ClassRun& ghosts = run.classes["ghost"];
  ghosts.counts.false_positives = 1;
  for (auto& ranked : cups.ranked) ranked = {{0.9, true}};
  for (auto& ranked : ghosts.ranked) ranked = {{0.9, false}};
  const RunTables tables = run_tables(std::span(&run, 1));
  EXPECT_DOUBLE_EQ(*tables.classes.at("cup").rates.average_precision[0], 0.5);
  EXPECT_FALSE(tables.classes.at("ghost").rates.average_precision[0]);
  EXPECT_THAT(tables.classes.at("ghost").curve, IsEmpty());
  EXPECT_DOUBLE_EQ(*tables.all.average_precision[0], 0.75);
  EXPECT_DOUBLE_EQ(*tables.runs[0].average_precision[0], 0.75);
}

TEST(RunTables, OneRankingOverAllRuns) {
  // The false one of the second run is surer than the right one of the first.
  std::vector<RunRates> runs{tv_run({tabled_truth("1", Eigen::Vector3d::Zero())}), tv_run({}, 1)};
  for (auto& ranked : runs[1].classes["tv"].ranked) ranked = {{0.95, false}};
  const RunTables tables = run_tables(runs);
  EXPECT_DOUBLE_EQ(*tables.classes.at("tv").rates.average_precision[0], 0.5);
  EXPECT_DOUBLE_EQ(*tables.runs[0].average_precision[0], 1.0);
  EXPECT_FALSE(tables.runs[1].average_precision[0]);
  runs[1].has_confidences = false;
  EXPECT_FALSE(run_tables(runs).all.average_precision[0]);
}

TEST(RunTables, NoRunsGiveNoRows) {
  const RunTables tables = run_tables({});
  EXPECT_THAT(tables.classes, IsEmpty());
  EXPECT_THAT(tables.runs, IsEmpty());
  EXPECT_THAT(tables.figures, IsEmpty());
  EXPECT_THAT(tables.objects, IsEmpty());
  EXPECT_FALSE(tables.all.counts.precision());
}

}  // namespace
}  // namespace hypermap

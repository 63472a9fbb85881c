// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/evaluation/run_tables.hpp"

#include "hypermap/core/evaluation/student_interval.hpp"
#include "running_mean.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

/// What runs have of a class together.
void add(const ClassRun& more, ClassRun& sum) {
  sum.counts += more.counts;
  for (std::size_t i = 0; i < sum.ranked.size(); ++i)
    sum.ranked[i].insert(sum.ranked[i].end(), more.ranked[i].begin(), more.ranked[i].end());
  sum.errors_m.insert(sum.errors_m.end(), more.errors_m.begin(), more.errors_m.end());
  sum.overlaps.insert(sum.overlaps.end(), more.overlaps.begin(), more.overlaps.end());
}

std::optional<double> mean_of(std::span<const double> values) {
  RunningMean mean;
  for (const double value : values) mean.add(value);
  return mean.value();
}

/// All figures but average precision.
RateRow row_without_ranking(const ClassRun& run) {
  return {
      .counts = run.counts, .box_iou = mean_of(run.overlaps), .position = summarised(run.errors_m)};
}

RateRow class_row(const ClassRun& run, bool is_ranked) {
  RateRow row = row_without_ranking(run);
  for (std::size_t i = 0; is_ranked && i < run.ranked.size(); ++i)
    row.average_precision[i] = average_precision(run.ranked[i], run.num_truths());
  return row;
}

/// A row over classes.
RateRow row_of_classes(const std::map<std::string, ClassRun>& classes, bool is_ranked) {
  ClassRun sum;
  std::array<std::vector<std::optional<double>>, kMatchCriteria.size()> precisions;
  for (const auto& [name, run] : classes) {
    add(run, sum);
    const RateRow row = class_row(run, is_ranked);
    for (std::size_t i = 0; i < precisions.size(); ++i)
      precisions[i].push_back(row.average_precision[i]);
  }
  RateRow row = row_without_ranking(sum);
  for (std::size_t i = 0; i < precisions.size(); ++i)
    row.average_precision[i] = mean_average_precision(precisions[i]);
  return row;
}

OverRuns over_runs(std::span<const std::optional<double>> values) {
  RunningMean mean;
  for (const auto& value : values) {
    if (value) mean.add(*value);
  }
  OverRuns result{.n = mean.n(), .mean = mean.value()};
  if (result.n < 2) return result;
  double squares = 0.0;
  for (const auto& value : values) {
    if (value) squares += (*value - *result.mean) * (*value - *result.mean);
  }
  result.std = std::sqrt(squares / static_cast<double>(result.n - 1));
  result.half_width_95 = student_half_width_95(*result.std, result.n);
  return result;
}

/// The figures of one run that have a mean over runs, in the order of output.
std::vector<std::pair<std::string, std::optional<double>>> figures_of(
    const RateRow& row, const Classifications& classifications, const RunFit& fit) {
  std::vector<std::pair<std::string, std::optional<double>>> figures{
      {"tpr", row.counts.true_positive_rate()},
      {"tnr", row.counts.true_negative_rate()},
      {"fpr", row.counts.false_positive_rate()},
      {"fnr", row.counts.false_negative_rate()},
      {"accuracy", row.counts.accuracy()},
      {"precision", row.counts.precision()},
      {"f1", row.counts.f1()},
      {"class_accuracy", classifications.accuracy()},
      {"jaccard_in_place", fit.jaccard_in_place},
      {"label_precision", fit.label_precision},
      {"label_recall", fit.label_recall}};
  for (const MatchCriterion criterion : kMatchCriteria)
    figures.emplace_back("map_" + std::string(key_of(criterion)),
                         row.average_precision[static_cast<std::size_t>(criterion)]);
  figures.emplace_back("box_iou", row.box_iou);
  figures.emplace_back("distance_m", row.position.mean_distance_m);
  const auto& rmse = row.position.rmse_m;
  figures.emplace_back("rmse_x_m", rmse ? std::optional(rmse->x()) : std::nullopt);
  figures.emplace_back("rmse_y_m", rmse ? std::optional(rmse->y()) : std::nullopt);
  figures.emplace_back("rmse_z_m", rmse ? std::optional(rmse->z()) : std::nullopt);
  figures.emplace_back("rmse_m", row.position.total_rmse_m);
  return figures;
}

std::vector<RunFigure> figures_over_runs(const RunTables& tables) {
  std::vector<std::string> keys;
  std::vector<std::vector<std::optional<double>>> values;
  for (std::size_t r = 0; r < tables.runs.size(); ++r) {
    const auto of_run =
        figures_of(tables.runs[r], tables.run_classifications[r], tables.run_fits[r]);
    values.resize(of_run.size());
    keys.resize(of_run.size());
    for (std::size_t i = 0; i < of_run.size(); ++i) {
      keys[i] = of_run[i].first;
      values[i].push_back(of_run[i].second);
    }
  }
  std::vector<RunFigure> figures;
  figures.reserve(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) figures.push_back({keys[i], over_runs(values[i])});
  return figures;
}

/// Fills `objects` and `mean_errors`.
void list_objects(std::span<const RunRates> runs, RunTables& tables) {
  std::map<std::pair<std::string, std::string>, std::size_t> row_of;
  std::vector<std::vector<Eigen::Vector3d>> errors;
  for (const RunRates& run : runs) {
    for (const TruthRun& truth : run.truths) {
      if (!truth.counts) continue;
      const auto [place, is_new] =
          row_of.try_emplace({truth.reference, truth.class_name}, tables.objects.size());
      if (is_new) {
        tables.objects.push_back({.reference = truth.reference, .class_name = truth.class_name});
        errors.emplace_back();
      }
      ObjectRow& row = tables.objects[place->second];
      ++row.num_counting;
      row.num_found += truth.object_id ? 1U : 0U;
      if (truth.error_m) errors[place->second].push_back(*truth.error_m);
    }
  }
  std::vector<Eigen::Vector3d> means;
  means.reserve(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    tables.objects[i].position = summarised(errors[i]);
    if (const auto& mean = tables.objects[i].position.mean_m) means.push_back(*mean);
  }
  tables.mean_errors = summarised(means);
}

}  // namespace

std::optional<double> OverRuns::low_95() const {
  return half_width_95 ? std::optional(*mean - *half_width_95) : std::nullopt;
}

std::optional<double> OverRuns::high_95() const {
  return half_width_95 ? std::optional(*mean + *half_width_95) : std::nullopt;
}

RunTables run_tables(std::span<const RunRates> runs) {
  RunTables tables;
  std::map<std::string, ClassRun> together;
  bool is_ranked = true;
  for (const RunRates& run : runs) {
    is_ranked = is_ranked && run.has_confidences;
    for (const auto& [name, of_class] : run.classes) {
      const auto [sum, is_new] = together.try_emplace(name, of_class);
      if (!is_new) add(of_class, sum->second);
    }
    tables.runs.push_back(row_of_classes(run.classes, run.has_confidences));
    tables.run_classifications.push_back(run.classifications);
    tables.run_fits.push_back(run.fit);
    tables.classifications += run.classifications;
  }
  for (const auto& [name, run] : together) {
    ClassRow& row = tables.classes[name];
    row.rates = class_row(run, is_ranked);
    if (is_ranked && run.num_truths() > 0)
      row.curve = precision_recall(run.ranked.front(), run.num_truths());
  }
  tables.all = row_of_classes(together, is_ranked);
  tables.figures = figures_over_runs(tables);
  list_objects(runs, tables);
  return tables;
}

}  // namespace hypermap

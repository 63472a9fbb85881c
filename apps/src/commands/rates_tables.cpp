// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/count_text.hpp"
#include "rates_texts.hpp"
#include "tables.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

constexpr int kRateDigits = 3;
constexpr int kRateMetreDigits = 3;

std::optional<double> axis_of(const std::optional<Eigen::Vector3d>& vector, Eigen::Index axis) {
  if (!vector) return std::nullopt;
  return (*vector)[axis];
}

std::string count_of(const std::optional<std::size_t>& count) {
  return count ? std::to_string(*count) : "-";
}

Table rate_table(const std::string& first) {
  return Table({first,        "things", "TP",     "FP",  "FN",  "TN",      "TPr",
                "TNr",        "FPr",    "FNr",    "ACC", "PRE", "AP gate", "AP IoU .25",
                "AP IoU .50", "3D IoU", "RMSE x", "y",   "z",   "xyz m"});
}

std::vector<std::string> rate_row(const std::string& name, const RateRow& row) {
  const BinaryCounts& counts = row.counts;
  std::vector<std::string> cells{name,
                                 std::to_string(counts.true_positives + counts.false_negatives),
                                 std::to_string(counts.true_positives),
                                 std::to_string(counts.false_positives),
                                 std::to_string(counts.false_negatives),
                                 count_of(counts.true_negatives),
                                 fixed(counts.true_positive_rate(), kRateDigits),
                                 fixed(counts.true_negative_rate(), kRateDigits),
                                 fixed(counts.false_positive_rate(), kRateDigits),
                                 fixed(counts.false_negative_rate(), kRateDigits),
                                 fixed(counts.accuracy(), kRateDigits),
                                 fixed(counts.precision(), kRateDigits)};
  for (const auto& precision : row.average_precision)
    cells.push_back(fixed(precision, kRateDigits));
  cells.push_back(fixed(row.box_iou, kRateDigits));
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    cells.push_back(fixed(axis_of(row.position.rmse_m, axis), kRateMetreDigits));
  cells.push_back(fixed(row.position.total_rmse_m, kRateMetreDigits));
  return cells;
}

std::string class_text(const RunTables& tables) {
  Table table = rate_table("class");
  for (const auto& [name, row] : tables.classes) table.add(rate_row(printable(name), row.rates));
  table.add(rate_row("all", tables.all));
  return table.text();
}

/// Requires: a key of run_tables.
const OverRuns& figure_called(const RunTables& tables, std::string_view key) {
  return std::find_if(tables.figures.begin(),
                      tables.figures.end(),
                      [key](const RunFigure& one) { return one.key == key; })
      ->over_runs;
}

/// Below the runs: `cell` of each figure that has a mean over them.
std::vector<std::string> over_runs_row(const std::string& name,
                                       const RunTables& tables,
                                       std::optional<double> OverRuns::*cell) {
  constexpr const char* kKeys[] = {"tpr",
                                   "tnr",
                                   "fpr",
                                   "fnr",
                                   "accuracy",
                                   "precision",
                                   "map_gate",
                                   "map_iou25",
                                   "map_iou50",
                                   "box_iou",
                                   "rmse_x_m",
                                   "rmse_y_m",
                                   "rmse_z_m",
                                   "rmse_m"};
  std::vector<std::string> cells{name, "", "", "", "", ""};
  for (const char* key : kKeys)
    cells.push_back(fixed(figure_called(tables, key).*cell, kRateDigits));
  return cells;
}

/// Means of the figures by which ways of mapping are compared, with their confidence intervals.
std::string mean_text(const RunTables& tables) {
  constexpr std::pair<const char*, const char*> kFigures[] = {
      {"precision", "precision"},
      {"recall", "tpr"},
      {"F1", "f1"},
      {"Jaccard in place", "jaccard_in_place"},
      {"distance of centres m", "distance_m"},
      {"3D IoU", "box_iou"},
      {"classes right", "class_accuracy"},
      {"label precision", "label_precision"},
      {"label recall", "label_recall"}};
  Table table({"over the runs", "runs", "mean", "95 % from", "to"});
  for (const auto& [name, key] : kFigures) {
    const OverRuns& figure = figure_called(tables, key);
    table.add({name,
               std::to_string(figure.n),
               fixed(figure.mean, kRateDigits),
               fixed(figure.low_95(), kRateDigits),
               fixed(figure.high_95(), kRateDigits)});
  }
  return "\n" + table.text();
}

std::string run_text(const RunTables& tables, const std::vector<RunName>& names) {
  if (tables.runs.size() < 2) return "";
  Table table = rate_table("run");
  for (std::size_t i = 0; i < tables.runs.size(); ++i)
    table.add(rate_row(printable(names[i].map), tables.runs[i]));
  table.add(over_runs_row("mean", tables, &OverRuns::mean));
  table.add(over_runs_row("std", tables, &OverRuns::std));
  table.add(over_runs_row("95 % +-", tables, &OverRuns::half_width_95));
  return "\n" + table.text() + mean_text(tables);
}

std::vector<std::string> object_cells(const std::string& name,
                                      const std::string& class_name,
                                      const std::string& found,
                                      const std::optional<Eigen::Vector3d>& vector,
                                      const std::optional<double>& distance_m,
                                      const std::optional<double>& std_m) {
  return {name,
          class_name,
          found,
          fixed(axis_of(vector, 0), kRateMetreDigits),
          fixed(axis_of(vector, 1), kRateMetreDigits),
          fixed(axis_of(vector, 2), kRateMetreDigits),
          fixed(distance_m, kRateMetreDigits),
          fixed(std_m, kRateMetreDigits)};
}

std::string object_text(const RunTables& tables) {
  if (tables.objects.empty()) return "";
  Table table(
      {"thing", "class", "found", "error x m", "y m", "z m", "distance m", "std over runs m"});
  for (const ObjectRow& row : tables.objects) {
    table.add(
        object_cells(printable(row.reference),
                     printable(row.class_name),
                     std::to_string(row.num_found) + " of " + std::to_string(row.num_counting),
                     row.position.mean_m,
                     row.position.mean_distance_m,
                     row.position.std_distance_m));
  }
  const PositionErrorSummary& errors = tables.mean_errors;
  table.add(object_cells("RMSE", "", "", errors.rmse_m, errors.total_rmse_m, std::nullopt));
  return "\n" + table.text();
}

std::string remarks(const RatesOutcome& outcome) {
  const Classifications& classes = outcome.tables.classifications;
  std::string text = "\nclasses of what is real: " + std::to_string(classes.num_right) + " of " +
                     count_text(classes.num_all, "object") + " right";
  if (classes.num_all > 0) text += " (ACC " + fixed(classes.accuracy(), kRateDigits) + ")";
  text += "\n";
  for (const std::string& unknown : outcome.unknown) text += "not known: " + unknown + "\n";
  return text;
}

}  // namespace

std::string table_text_of(const RatesOutcome& outcome, const std::vector<RunName>& names) {
  std::string text = class_text(outcome.tables);
  text += run_text(outcome.tables, names);
  text += object_text(outcome.tables);
  text += remarks(outcome);
  return text;
}

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
#include "rates_texts.hpp"

#include <optional>

namespace hypermap::app {
namespace {

std::vector<std::string> rate_heading(std::vector<std::string> first) {
  for (const char* name :
       {"things",  "TP",         "FP",       "FN",       "TN",       "TPr",      "TNr",
        "FPr",     "FNr",        "ACC",      "PRE",      "AP_gate",  "AP_iou25", "AP_iou50",
        "box_iou", "distance_m", "rmse_x_m", "rmse_y_m", "rmse_z_m", "rmse_m"})
    first.emplace_back(name);
  return first;
}

void add_rates(CsvText& csv, const RateRow& row) {
  const BinaryCounts& counts = row.counts;
  csv.add(counts.true_positives + counts.false_negatives);
  csv.add(counts.true_positives);
  csv.add(counts.false_positives);
  csv.add(counts.false_negatives);
  csv.add(counts.true_negatives);
  csv.add(counts.true_positive_rate());
  csv.add(counts.true_negative_rate());
  csv.add(counts.false_positive_rate());
  csv.add(counts.false_negative_rate());
  csv.add(counts.accuracy());
  csv.add(counts.precision());
  for (const auto& precision : row.average_precision) csv.add(precision);
  csv.add(row.box_iou);
  csv.add(row.position.mean_distance_m);
  csv.add(row.position.rmse_m);
  csv.add(row.position.total_rmse_m);
  csv.end_line();
}

std::string classes_csv(const RunTables& tables) {
  CsvText csv(rate_heading({"class"}));
  for (const auto& [name, row] : tables.classes) {
    csv.add(name);
    add_rates(csv, row.rates);
  }
  csv.add("all");
  add_rates(csv, tables.all);
  return csv.text();
}

std::string runs_csv(const RunTables& tables, const std::vector<RunName>& names) {
  CsvText csv(rate_heading({"map", "truth"}));
  for (std::size_t i = 0; i < tables.runs.size(); ++i) {
    csv.add(names[i].map);
    csv.add(names[i].truth);
    add_rates(csv, tables.runs[i]);
  }
  return csv.text();
}

/// A row for each figure that has a mean over runs.
std::string over_runs_csv(const RunTables& tables) {
  CsvText csv({"figure", "n", "mean", "std", "low_95", "high_95"});
  for (const RunFigure& figure : tables.figures) {
    const OverRuns& over_runs = figure.over_runs;
    csv.add(figure.key);
    csv.add(over_runs.n);
    csv.add(over_runs.mean);
    csv.add(over_runs.std);
    csv.add(over_runs.low_95());
    csv.add(over_runs.high_95());
    csv.end_line();
  }
  return csv.text();
}

std::string instances_csv(const RunTables& tables) {
  CsvText csv({"thing",
               "class",
               "runs",
               "found",
               "error_x_m",
               "error_y_m",
               "error_z_m",
               "distance_m",
               "std_distance_m"});
  for (const ObjectRow& row : tables.objects) {
    csv.add(row.reference);
    csv.add(row.class_name);
    csv.add(row.num_counting);
    csv.add(row.num_found);
    csv.add(row.position.mean_m);
    csv.add(row.position.mean_distance_m);
    csv.add(row.position.std_distance_m);
    csv.end_line();
  }
  return csv.text();
}

std::string positions_csv(const RatesOutcome& outcome, const std::vector<RunName>& names) {
  CsvText csv({"map",
               "truth",
               "thing",
               "class",
               "counts",
               "object",
               "true_x_m",
               "true_y_m",
               "true_z_m",
               "x_m",
               "y_m",
               "z_m",
               "error_x_m",
               "error_y_m",
               "error_z_m",
               "box_iou"});
  for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
    for (const TruthRun& instance : outcome.runs[i].truths) {
      csv.add(names[i].map);
      csv.add(names[i].truth);
      csv.add(instance.reference);
      csv.add(instance.class_name);
      csv.add(std::string(instance.counts ? "yes" : "no"));
      csv.add(instance.object_id ? std::to_string(*instance.object_id) : std::string());
      csv.add(instance.true_centre);
      csv.add(instance.centre);
      csv.add(instance.error_m);
      csv.add(instance.overlap);
      csv.end_line();
    }
  }
  return csv.text();
}

std::string false_csv(const RatesOutcome& outcome, const std::vector<RunName>& names) {
  CsvText csv({"map", "truth", "object", "class", "x_m", "y_m", "z_m", "confidence"});
  for (std::size_t i = 0; i < outcome.runs.size(); ++i) {
    for (const FalseObject& object : outcome.runs[i].false_objects) {
      csv.add(names[i].map);
      csv.add(names[i].truth);
      csv.add(std::to_string(object.object_id));
      csv.add(object.class_name);
      csv.add(std::optional(object.place));
      csv.add(object.confidence);
      csv.end_line();
    }
  }
  return csv.text();
}

}  // namespace

std::vector<CsvFile> csv_files_of(const RatesOutcome& outcome, const std::vector<RunName>& names) {
  return {{.name = kCsvNames[0], .text = classes_csv(outcome.tables)},
          {.name = kCsvNames[1], .text = runs_csv(outcome.tables, names)},
          {.name = kCsvNames[2], .text = instances_csv(outcome.tables)},
          {.name = kCsvNames[3], .text = positions_csv(outcome, names)},
          {.name = kCsvNames[4], .text = false_csv(outcome, names)},
          {.name = kCsvNames[5], .text = over_runs_csv(outcome.tables)}};
}

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_eval.hpp"

#include "csv_text.hpp"
#include "hypermap/core/base/count_text.hpp"
#include "json_numbers.hpp"
#include "placement_argument.hpp"
#include "tables.hpp"
#include "voxel_texts.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

using CloudJson = nlohmann::ordered_json;

std::optional<double> coverage_of(const CloudEvaluation& evaluation, const std::string& name) {
  const auto found = evaluation.coverage_of_class.find(name);
  return found == evaluation.coverage_of_class.end() ? std::nullopt : found->second.share();
}

CloudJson json_of(const std::optional<PointDistances>& distances) {
  if (!distances) return nullptr;
  return {{"n", distances->n},
          {"mean_m", distances->mean_m},
          {"median_m", distances->median_m},
          {"p95_m", distances->upper_m},
          {"max_m", distances->max_m}};
}

/// A row with the share of the cloud that is covered before what a class is confused for.
std::vector<std::string> with_coverage(std::vector<std::string> row, std::string covered) {
  row.insert(row.end() - 1, std::move(covered));
  return row;
}

VoxelLabelCounts totals_of(const ClassVoxelCounts& counts) {
  return {.labelled = counts.labelled,
          .right = counts.right_labels,
          .wrong_class = counts.wrong_class,
          .true_voxels = counts.true_voxels,
          .true_right = counts.found,
          .true_unlabelled = counts.true_unlabelled};
}

void add_counts(CsvText& csv, const VoxelLabelCounts& counts, std::optional<double> covered) {
  csv.add(counts.labelled);
  csv.add(counts.right);
  csv.add(counts.wrong_class);
  csv.add(counts.precision());
  csv.add(counts.true_voxels);
  csv.add(counts.true_right);
  csv.add(counts.true_unlabelled);
  csv.add(counts.recall());
  csv.add(covered);
  csv.end_line();
}

std::string csv_text_of(const CloudEvaluation& evaluation) {
  CsvText csv({"class",
               "labelled",
               "right",
               "wrong_class",
               "precision",
               "true",
               "found",
               "unlabelled",
               "recall",
               "covered"});
  for (const auto& [name, counts] : evaluation.classes) {
    csv.add(name);
    add_counts(csv, totals_of(counts), coverage_of(evaluation, name));
  }
  csv.add("all");
  add_counts(csv, evaluation.all, evaluation.coverage.share());
  return csv.text();
}

/// The flag that gives the field of a job.
Error in_cloud_flags(Error error) {
  if (error.field == "labels") error.field = "--labels";
  return error;
}

}  // namespace

void CloudArguments::add_to(CLI::App& command) {
  command.add_option("--labels",
                     label_names,
                     "with a cloud: YAML file of what its labels mean, `3: chair` a line (default: "
                     "what comments of a PLY file say)");
  command
      .add_option("--transform",
                  placement,
                  "with a cloud: X,Y,Z,YAW, where its origin lies in the map, metres and degrees")
      ->check(placement_text());
}

std::string json_text_of(const CloudEvaluationOutcome& outcome) {
  const CloudEvaluation& evaluation = outcome.evaluation;
  CloudJson json = voxel_json(evaluation.all);
  json["off_cloud"] = evaluation.labelled_off_cloud;
  json["precision_at_cloud"] = number_json(evaluation.precision_at_cloud());
  json["covered"] = number_json(evaluation.coverage.share());
  json["distances"] = json_of(evaluation.distances);
  json["points"] = evaluation.num_points;
  json["points_without_class"] = evaluation.num_without_class;
  json["points_unmeasured"] = outcome.num_unmeasured;
  json["classes"] = CloudJson::object();
  for (const auto& [name, counts] : evaluation.classes) {
    json["classes"][name] = voxel_json(counts);
    json["classes"][name]["covered"] = number_json(coverage_of(evaluation, name));
  }
  return json.dump(2) + "\n";
}

std::string table_text_of(const CloudEvaluationOutcome& outcome) {
  const CloudEvaluation& evaluation = outcome.evaluation;
  Table table(with_coverage(voxel_headings(), "covered"));
  for (const auto& [name, counts] : evaluation.classes) {
    table.add(with_coverage(voxel_row(name, counts), fixed(coverage_of(evaluation, name), 2)));
  }
  table.add(with_coverage(voxel_row(evaluation.all), fixed(evaluation.coverage.share(), 2)));
  std::string text = table.text();
  text += std::to_string(evaluation.labelled_off_cloud) +
          " of the labelled voxels are near no point of the cloud; precision over the others " +
          fixed(evaluation.precision_at_cloud(), 2) + "\n";
  text += count_text(evaluation.num_points, "point") + ", " +
          std::to_string(evaluation.num_without_class) + " of them without a class\n";
  if (const auto& distances = evaluation.distances) {
    text += "from points to occupied space: mean " + fixed(distances->mean_m, 4) + " m, median " +
            fixed(distances->median_m, 4) + " m, 95 % within " + fixed(distances->upper_m, 4) +
            " m, farthest " + fixed(distances->max_m, 4) + " m\n";
  }
  return text;
}

ExitCode run_cloud_eval(CloudEvaluationJob job,
                        const CloudArguments& arguments,
                        const CloudReport& form) {
  if (arguments.label_names) job.label_names = *arguments.label_names;
  const auto placement = placement_of(arguments.placement);
  if (!placement) return report(placement.error());
  if (*placement) job.map_from_cloud = MapFromInput(isometry_of(**placement));
  const auto outcome = run_cloud_evaluation(job);
  if (!outcome) return report(in_cloud_flags(outcome.error()));
  if (form.csv) {
    const auto written = write_csv_files(
        {{.name = kVoxelCsvName, .text = csv_text_of(outcome->evaluation)}}, *form.csv);
    if (!written) return report(written.error());
  }
  std::printf("%s", (form.as_json ? json_text_of(*outcome) : table_text_of(*outcome)).c_str());
  return ExitCode::kDone;
}

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_eval.hpp"

#include "hypermap/core/base/count_text.hpp"
#include "placement_argument.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

using CloudJson = nlohmann::ordered_json;

CloudJson optional_number(const std::optional<double>& value) {
  return value ? CloudJson(*value) : CloudJson(nullptr);
}

std::optional<double> coverage_of(const CloudEvaluation& evaluation, const std::string& name) {
  const auto found = evaluation.coverage_of_class.find(name);
  return found == evaluation.coverage_of_class.end() ? std::nullopt : found->second.share();
}

CloudJson json_of(const std::string& name,
                  const ClassVoxelCounts& counts,
                  const CloudEvaluation& evaluation) {
  CloudJson confused = CloudJson::object();
  for (const auto& [other, n] : counts.confused_for) confused[other] = n;
  return {{"labelled", counts.labelled},
          {"right", counts.right_labels},
          {"wrong_class", counts.wrong_class},
          {"precision", optional_number(counts.precision())},
          {"true", counts.true_voxels},
          {"found", counts.found},
          {"unlabelled", counts.true_unlabelled},
          {"recall", optional_number(counts.recall())},
          {"covered", optional_number(coverage_of(evaluation, name))},
          {"confused_for", std::move(confused)}};
}

CloudJson json_of(const std::optional<PointDistances>& distances) {
  if (!distances) return nullptr;
  return {{"n", distances->n},
          {"mean_m", distances->mean_m},
          {"median_m", distances->median_m},
          {"p95_m", distances->upper_m},
          {"max_m", distances->max_m}};
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
  const VoxelLabelCounts& all = evaluation.all;
  CloudJson json{{"labelled", all.labelled},
                 {"right", all.right},
                 {"wrong_class", all.wrong_class},
                 {"off_cloud", evaluation.labelled_off_cloud},
                 {"precision", optional_number(all.precision())},
                 {"precision_at_cloud", optional_number(evaluation.precision_at_cloud())},
                 {"true", all.true_voxels},
                 {"found", all.true_right},
                 {"unlabelled", all.true_unlabelled},
                 {"recall", optional_number(all.recall())},
                 {"covered", optional_number(evaluation.coverage.share())},
                 {"distances", json_of(evaluation.distances)},
                 {"points", evaluation.num_points},
                 {"points_without_class", evaluation.num_without_class},
                 {"points_unmeasured", outcome.num_unmeasured},
                 {"classes", CloudJson::object()}};
  for (const auto& [name, counts] : evaluation.classes)
    json["classes"][name] = json_of(name, counts, evaluation);
  return json.dump(2) + "\n";
}

std::string table_text_of(const CloudEvaluationOutcome& outcome) {
  const CloudEvaluation& evaluation = outcome.evaluation;
  Table table({"voxels of class",
               "labelled",
               "precision",
               "wrong class",
               "true",
               "recall",
               "unlabelled",
               "covered",
               "most confused for"});
  for (const auto& [name, counts] : evaluation.classes) {
    const auto confused = counts.most_confused_for();
    table.add({printable(name),
               std::to_string(counts.labelled),
               fixed(counts.precision(), 2),
               std::to_string(counts.wrong_class),
               std::to_string(counts.true_voxels),
               fixed(counts.recall(), 2),
               std::to_string(counts.true_unlabelled),
               fixed(coverage_of(evaluation, name), 2),
               confused ? printable(*confused) : "-"});
  }
  const VoxelLabelCounts& all = evaluation.all;
  table.add({"all",
             std::to_string(all.labelled),
             fixed(all.precision(), 2),
             std::to_string(all.wrong_class),
             std::to_string(all.true_voxels),
             fixed(all.recall(), 2),
             std::to_string(all.true_unlabelled),
             fixed(evaluation.coverage.share(), 2),
             "-"});
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

ExitCode run_cloud_eval(CloudEvaluationJob job, const CloudArguments& arguments, bool as_json) {
  if (arguments.label_names) job.label_names = *arguments.label_names;
  const auto placement = placement_of(arguments.placement);
  if (!placement) return report(placement.error());
  if (*placement) job.map_from_cloud = MapFromInput(isometry_of(**placement));
  const auto outcome = run_cloud_evaluation(job);
  if (!outcome) return report(in_cloud_flags(outcome.error()));
  std::printf("%s", (as_json ? json_text_of(*outcome) : table_text_of(*outcome)).c_str());
  return ExitCode::kDone;
}

}  // namespace hypermap::app

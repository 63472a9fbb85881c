// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "eval_arguments.hpp"
#include "evaluation_images.hpp"
#include "evaluation_texts.hpp"
#include "outputs.hpp"
#include "rates_texts.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

/// No table may be written over what is read.
void keep_csv_apart(const EvalArguments& arguments) {
  const std::filesystem::path folder = *arguments.csv;
  keep_out_of_datasets("--csv", folder);
  for (const char* name : kCsvNames) keep_apart("--csv", folder / name, inputs_of(arguments));
  keep_apart("--csv", folder / kVoxelCsvName, inputs_of(arguments));
}

/// The error with the option that gives the field of a job.
Error in_flags(Error error) {
  for (const auto& [field, option] : {std::pair("classes", "--classes"),
                                      std::pair("frames", "--input"),
                                      std::pair("maps", "--map"),
                                      std::pair("truths", "--truth")}) {
    if (error.file.empty() && error.field == field) {
      error.field = option;
      break;
    }
  }
  return error;
}

EvaluationImages images_of(const EvalArguments& arguments, const EvaluationJob& job) {
  return {.reliability = arguments.reliability,
          .plan = arguments.image,
          .title = job.map.filename().string() + " over " + job.truth.filename().string()};
}

/// The images that were asked for beside the tables: those of the usual report.
Result<void> draw_beside_rates(const EvalArguments& arguments) {
  if (!arguments.image && !arguments.reliability) return {};
  const FileKind truth = find_file_kind(arguments.truths.front()).value_or(FileKind::kArchive);
  HYPERMAP_TRY(check_options_of(arguments, truth));
  HYPERMAP_ASSIGN_OR_RETURN(const EvaluationJob job, job_of(arguments));
  HYPERMAP_ASSIGN_OR_RETURN(const EvaluationOutcome outcome, run_evaluation(job));
  return write_images(outcome, images_of(arguments, job));
}

ExitCode run_rates(const EvalArguments& arguments) {
  if (const auto fits = check_options_of_runs(arguments); !fits) return report(fits.error());
  if (const auto drawn = draw_beside_rates(arguments); !drawn)
    return report(in_flags(drawn.error()));
  const auto job = rates_job_of(arguments);
  if (!job) return report(job.error());
  const auto outcome = run_rates_job(*job);
  if (!outcome) return report(in_flags(outcome.error()));
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : outcome->findings) worst = std::max(worst, report(finding));
  const std::vector<RunName> names = run_names(*job);
  if (arguments.csv) {
    const auto written = write_csv_files(csv_files_of(*outcome, names), *arguments.csv);
    if (!written) return report(written.error());
  }
  const std::string text =
      arguments.json ? json_text_of(*outcome, names) : table_text_of(*outcome, names);
  std::printf("%s", text.c_str());
  return worst;
}

ExitCode run_listed_eval(const EvalArguments& arguments) {
  const auto job = listed_job_of(arguments);
  if (!job) return report(job.error());
  const auto outcome = run_listed_evaluation(*job);
  if (!outcome) return report(outcome.error());
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : outcome->findings) worst = std::max(worst, report(finding));
  const std::string text =
      arguments.json ? json_text_of(*outcome, job->options) : table_text_of(*outcome, job->options);
  std::printf("%s", text.c_str());
  return worst;
}

ExitCode run_eval_of_cloud(const EvalArguments& arguments) {
  auto job = cloud_job_of(arguments);
  if (!job) return report(job.error());
  return run_cloud_eval(
      *std::move(job), arguments.cloud, {.as_json = arguments.json, .csv = arguments.csv});
}

ExitCode run_eval(const EvalArguments& arguments) {
  // A truth that cannot be read is reported by the reader of archives.
  const FileKind truth = find_file_kind(arguments.truths.front()).value_or(FileKind::kArchive);
  if (arguments.asks_for_rates(truth)) return run_rates(arguments);
  if (const auto fits = check_options_of(arguments, truth); !fits) return report(fits.error());
  if (truth == FileKind::kTruth) return run_listed_eval(arguments);
  if (truth == FileKind::kCloud) return run_eval_of_cloud(arguments);
  const auto job = job_of(arguments);
  if (!job) return report(job.error());
  const auto outcome = run_evaluation(*job);
  if (!outcome) return report(in_flags(outcome.error()));
  if (const auto written = write_images(*outcome, images_of(arguments, *job)); !written)
    return report(written.error());
  const std::string text = arguments.json ? json_text_of(*outcome) : table_text_of(*outcome);
  std::printf("%s", text.c_str());
  return ExitCode::kDone;
}

}  // namespace

void add_eval_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<EvalArguments>();
  CLI::App& command =
      *program.add_subcommand("eval", "How good a map is, measured against a truth");
  command
      .add_option("--map",
                  arguments->maps,
                  "archive or semantic YAML to evaluate; several are runs, see --rates")
      ->required();
  command
      .add_option("--truth",
                  arguments->truths,
                  "archive or semantic YAML that is right, a list of what stands in a recorded "
                  "sequence (data/truth), or a labelled cloud (PCD, PLY); of several maps one for "
                  "all, or one for each")
      ->required();
  auto* against = command.add_option(
      "--against", arguments->against, "another map of the same place, to compare");
  auto* also =
      command.add_option("--also",
                         arguments->also,
                         "a further map and its truth, for the calibration alone; repeatable");
  command.add_option("--layer", arguments->layer, "semantic layer in each")->capture_default_str();
  command
      .add_option("--classes",
                  arguments->classes,
                  "only these, as query --string takes them, separated by commas")
      ->delimiter(',');
  command.add_option(
      "--reliability", arguments->reliability, "PNG to write: P(best class) left, P(real) right");
  command.add_option(
      "--image", arguments->image, "PNG to write: map and truth over each other, from above");
  auto* input =
      command.add_option("--input",
                         arguments->input,
                         "with a list: the sequence, to count how often things were named");
  command.add_option("--dataset", arguments->description, kDescriptionHelp)->needs(input);
  command
      .add_option("--detections",
                  arguments->detections,
                  "with --input: detections file, one a detector; may be repeated")
      ->needs(input);
  command.add_flag("--json", arguments->json, "one JSON document");
  command
      .add_flag("--rates",
                arguments->rates,
                "tables of classes, runs and things instead: true and false positives and "
                "negatives with their rates, average precision, overlap of boxes, position errors; "
                "of several maps also means with their 95 % intervals")
      ->excludes(against)
      ->excludes(also);
  command
      .add_option("--csv",
                  arguments->csv,
                  "folder for these tables as classes.csv, runs.csv, things.csv, positions.csv, "
                  "false.csv, over_runs.csv; of a cloud voxels.csv")
      ->excludes(against)
      ->excludes(also);
  arguments->cloud.add_to(command);
  arguments->class_names.add_to(command);
  arguments->load.add_to(command);
  show_examples(
      command,
      {"hypermap eval --map lab.hmap --truth lab/truth.hmap",
       "hypermap eval --map a.hmap --truth a/truth.hmap --also b.hmap b/truth.hmap "
       "--reliability plot.png",
       "hypermap eval --map lab.hmap --truth lab/truth.hmap --image plan.png",
       "hypermap eval --map kitchen.hmap --truth data/truth/kitchen.yaml --input kitchen "
       "--detections kitchen.jsonl",
       "hypermap eval --map lab.hmap --truth scan.ply --labels names.yaml",
       "hypermap eval --map a.hmap b.hmap --truth a/truth.hmap b/truth.hmap --csv tables"});
  command.callback([arguments, &action] {
    if (arguments->reliability) {
      keep_apart("--reliability", *arguments->reliability, inputs_of(*arguments));
      keep_suffix("--reliability", *arguments->reliability, ".png");
    }
    if (arguments->image) {
      keep_apart("--image", *arguments->image, inputs_of(*arguments));
      keep_suffix("--image", *arguments->image, ".png");
    }
    if (arguments->csv) keep_csv_apart(*arguments);
    action = [arguments] { return run_eval(*arguments); };
  });
}

}  // namespace hypermap::app

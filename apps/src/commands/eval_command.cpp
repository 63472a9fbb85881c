// SPDX-License-Identifier: BSD-3-Clause
#include "class_names.hpp"
#include "command.hpp"
#include "dataset_arguments.hpp"
#include "evaluation_texts.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/file_kind.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"
#include "hypermap/io/jobs/listed_evaluation_job.hpp"
#include "hypermap/io/jobs/reliability_plot.hpp"
#include "load_arguments.hpp"
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

struct EvalArguments {
  std::vector<std::string> maps;
  std::vector<std::string> truths;
  std::optional<std::string> against;
  std::vector<std::pair<std::string, std::string>> also;
  std::string layer = "semantic";
  std::vector<std::string> classes;
  std::optional<std::string> reliability;
  std::optional<std::string> input;
  std::optional<std::string> description;
  std::vector<std::string> detections;
  bool json = false;
  bool rates = false;
  std::optional<std::string> csv;
  ClassNames class_names;
  LoadArguments load;

  [[nodiscard]] bool asks_for_rates() const {
    return rates || csv || maps.size() > 1 || truths.size() > 1;
  }
};

Result<EvaluationJob> job_of(const EvalArguments& arguments) {
  EvaluationJob job{
      .map = arguments.maps.front(), .truth = arguments.truths.front(), .layer = arguments.layer};
  if (arguments.against) job.against = *arguments.against;
  for (const auto& [map, truth] : arguments.also) job.also.push_back({map, truth});
  job.options.classes = arguments.classes;
  HYPERMAP_ASSIGN_OR_RETURN(job.vocabulary, arguments.class_names.given());
  job.limits = arguments.load.limits;
  job.stop = stop_when_interrupted();
  return job;
}

std::vector<std::filesystem::path> inputs_of(const EvalArguments& arguments) {
  std::vector<std::filesystem::path> inputs{arguments.against.value_or(""),
                                            arguments.class_names.file};
  inputs.insert(inputs.end(), arguments.maps.begin(), arguments.maps.end());
  inputs.insert(inputs.end(), arguments.truths.begin(), arguments.truths.end());
  for (const auto& [map, truth] : arguments.also) {
    inputs.emplace_back(map);
    inputs.emplace_back(truth);
  }
  return inputs;
}

/// No table may be written over what is read.
void keep_csv_apart(const EvalArguments& arguments) {
  const std::filesystem::path folder = *arguments.csv;
  keep_out_of_datasets("--csv", folder);
  for (const char* name : kCsvNames) keep_apart("--csv", folder / name, inputs_of(arguments));
}

Result<void> write_plot(const std::string& path, const EvaluationOutcome& outcome) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                            encode_png(draw_reliability(outcome.best_class, outcome.real)));
  return write_file_atomically(path, bytes);
}

std::optional<NamingFrames> naming_frames_of(const EvalArguments& arguments) {
  if (!arguments.input) return std::nullopt;
  NamingFrames frames{.input = *arguments.input};
  if (arguments.description) frames.dataset.description = *arguments.description;
  frames.dataset.detections.assign(arguments.detections.begin(), arguments.detections.end());
  return frames;
}

Result<ListedEvaluationJob> listed_job_of(const EvalArguments& arguments) {
  ListedEvaluationJob job{
      .map = arguments.maps.front(), .truth = arguments.truths.front(), .layer = arguments.layer};
  job.frames = naming_frames_of(arguments);
  HYPERMAP_ASSIGN_OR_RETURN(job.vocabulary, arguments.class_names.given());
  job.limits = arguments.load.limits;
  job.stop = stop_when_interrupted();
  return job;
}

Result<RatesJob> rates_job_of(const EvalArguments& arguments) {
  RatesJob job{.frames = naming_frames_of(arguments), .layer = arguments.layer};
  job.maps.assign(arguments.maps.begin(), arguments.maps.end());
  job.truths.assign(arguments.truths.begin(), arguments.truths.end());
  job.options.classes = arguments.classes;
  HYPERMAP_ASSIGN_OR_RETURN(job.vocabulary, arguments.class_names.given());
  job.limits = arguments.load.limits;
  job.stop = stop_when_interrupted();
  return job;
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

/// What only one map allows. Errors: kInvalidArgument naming the option.
Result<void> check_options_of_runs(const EvalArguments& arguments) {
  for (const auto& [is_given, option] :
       {std::pair(arguments.against.has_value(), "--against"),
        std::pair(!arguments.also.empty(), "--also"),
        std::pair(arguments.reliability.has_value(), "--reliability")}) {
    if (is_given) return fail(ErrorCode::kInvalidArgument, "needs a single map", option);
  }
  return {};
}

/// What only the other kind of truth allows. Errors: kInvalidArgument naming the option.
Result<void> check_options_of(const EvalArguments& arguments, bool truth_is_list) {
  const auto refused = [](const char* option, const char* truth) {
    return fail(ErrorCode::kInvalidArgument, std::string("needs ") + truth + " as truth", option);
  };
  constexpr const char* kArchive = "an archive";
  if (!truth_is_list)
    return arguments.input ? refused("--input", "a list of things") : Result<void>();
  if (arguments.against) return refused("--against", kArchive);
  if (!arguments.also.empty()) return refused("--also", kArchive);
  if (!arguments.classes.empty()) return refused("--classes", kArchive);
  if (arguments.reliability) return refused("--reliability", kArchive);
  return {};
}

ExitCode run_rates(const EvalArguments& arguments) {
  if (const auto fits = check_options_of_runs(arguments); !fits) return report(fits.error());
  const auto job = rates_job_of(arguments);
  if (!job) return report(job.error());
  const auto outcome = run_rates_job(*job);
  if (!outcome) return report(in_flags(outcome.error()));
  ExitCode worst = ExitCode::kDone;
  for (const Finding& finding : outcome->findings) worst = std::max(worst, report(finding));
  const std::vector<RunName> names = run_names(*job);
  if (arguments.csv) {
    const auto written = write_csv_files(*outcome, names, *arguments.csv);
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

ExitCode run_eval(const EvalArguments& arguments) {
  if (arguments.asks_for_rates()) return run_rates(arguments);
  // A truth that cannot be read is reported by the reader of archives.
  const bool truth_is_list = find_file_kind(arguments.truths.front()) == FileKind::kTruth;
  if (const auto fits = check_options_of(arguments, truth_is_list); !fits)
    return report(fits.error());
  if (truth_is_list) return run_listed_eval(arguments);
  const auto job = job_of(arguments);
  if (!job) return report(job.error());
  const auto outcome = run_evaluation(*job);
  if (!outcome) return report(in_flags(outcome.error()));
  if (arguments.reliability) {
    if (const auto written = write_plot(*arguments.reliability, *outcome); !written)
      return report(written.error());
  }
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
      .add_option("--map", arguments->maps, "archive to evaluate; several are runs, see --rates")
      ->required();
  command
      .add_option("--truth",
                  arguments->truths,
                  "archive that is right, or a list of what stands in a recorded sequence "
                  "(data/truth); of several maps one for all, or one for each")
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
  auto* reliability = command.add_option(
      "--reliability", arguments->reliability, "PNG to write: P(best class) left, P(real) right");
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
                "negatives with their rates, average precision, overlap of boxes, position errors")
      ->excludes(against)
      ->excludes(also)
      ->excludes(reliability);
  command
      .add_option("--csv",
                  arguments->csv,
                  "folder for these tables as classes.csv, runs.csv, things.csv, positions.csv")
      ->excludes(against)
      ->excludes(also)
      ->excludes(reliability);
  arguments->class_names.add_to(command);
  arguments->load.add_to(command);
  show_examples(
      command,
      {"hypermap eval --map lab.hmap --truth lab/truth.hmap",
       "hypermap eval --map a.hmap --truth a/truth.hmap --also b.hmap b/truth.hmap "
       "--reliability plot.png",
       "hypermap eval --map kitchen.hmap --truth data/truth/kitchen.yaml --input kitchen "
       "--detections kitchen.jsonl",
       "hypermap eval --map a.hmap b.hmap --truth a/truth.hmap b/truth.hmap --csv tables"});
  command.callback([arguments, &action] {
    if (arguments->reliability) {
      keep_apart("--reliability", *arguments->reliability, inputs_of(*arguments));
      keep_suffix("--reliability", *arguments->reliability, ".png");
    }
    if (arguments->csv) keep_csv_apart(*arguments);
    action = [arguments] { return run_eval(*arguments); };
  });
}

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "evaluation_texts.hpp"
#include "hypermap/io/codec/atomic_file.hpp"
#include "hypermap/io/codec/png_image.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"
#include "hypermap/io/jobs/reliability_plot.hpp"
#include "load_arguments.hpp"
#include "outputs.hpp"

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap::app {
namespace {

struct EvalArguments {
  std::string map;
  std::string truth;
  std::optional<std::string> against;
  std::vector<std::pair<std::string, std::string>> also;
  std::string layer = "semantic";
  std::vector<std::string> classes;
  std::optional<std::string> reliability;
  bool json = false;
  LoadArguments load;
};

EvaluationJob job_of(const EvalArguments& arguments) {
  EvaluationJob job{.map = arguments.map, .truth = arguments.truth, .layer = arguments.layer};
  if (arguments.against) job.against = *arguments.against;
  for (const auto& [map, truth] : arguments.also) job.also.push_back({map, truth});
  job.options.classes = arguments.classes;
  job.limits = arguments.load.limits;
  job.stop = stop_when_interrupted();
  return job;
}

std::vector<std::filesystem::path> inputs_of(const EvalArguments& arguments) {
  std::vector<std::filesystem::path> inputs{
      arguments.map, arguments.truth, arguments.against.value_or("")};
  for (const auto& [map, truth] : arguments.also) {
    inputs.emplace_back(map);
    inputs.emplace_back(truth);
  }
  return inputs;
}

Result<void> write_plot(const std::string& path, const EvaluationOutcome& outcome) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::string bytes,
                            encode_png(draw_reliability(outcome.best_class, outcome.real)));
  return write_file_atomically(path, bytes);
}

ExitCode run_eval(const EvalArguments& arguments) {
  auto outcome = run_evaluation(job_of(arguments));
  if (!outcome) {
    if (outcome.error().field == "classes") outcome.error().field = "--classes";
    return report(outcome.error());
  }
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
  command.add_option("--map", arguments->map, "archive to evaluate")->required();
  command.add_option("--truth", arguments->truth, "archive that is right")->required();
  command.add_option("--against", arguments->against, "another map of the same place, to compare");
  command.add_option("--also",
                     arguments->also,
                     "a further map and its truth, for the calibration alone; repeatable");
  command.add_option("--layer", arguments->layer, "semantic layer in each")->capture_default_str();
  command.add_option("--classes", arguments->classes, "only these, separated by commas")
      ->delimiter(',');
  command.add_option(
      "--reliability", arguments->reliability, "PNG to write: P(best class) left, P(real) right");
  command.add_flag("--json", arguments->json, "one JSON document");
  arguments->load.add_to(command);
  show_examples(command,
                {"hypermap eval --map lab.hmap --truth lab/truth.hmap",
                 "hypermap eval --map a.hmap --truth a/truth.hmap --also b.hmap b/truth.hmap "
                 "--reliability plot.png"});
  command.callback([arguments, &action] {
    if (arguments->reliability) {
      keep_apart("--reliability", *arguments->reliability, inputs_of(*arguments));
      keep_suffix("--reliability", *arguments->reliability, ".png");
    }
    action = [arguments] { return run_eval(*arguments); };
  });
}

}  // namespace hypermap::app

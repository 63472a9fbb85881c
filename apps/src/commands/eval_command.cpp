// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/io/jobs/evaluation_job.hpp"
#include "load_arguments.hpp"
#include "tables.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

namespace hypermap::app {
namespace {

using Json = nlohmann::ordered_json;

struct EvalArguments {
  std::string map;
  std::string truth;
  std::optional<std::string> against;
  std::string layer = "semantic";
  std::vector<std::string> classes;
  bool json = false;
  LoadArguments load;
};

EvaluationJob job_of(const EvalArguments& arguments) {
  EvaluationJob job{.map = arguments.map, .truth = arguments.truth, .layer = arguments.layer};
  if (arguments.against) job.against = *arguments.against;
  job.options.classes = arguments.classes;
  job.limits = arguments.load.limits;
  job.stop = stop_when_interrupted();
  return job;
}

Json number(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json json_of(const NearestMetric& metric) {
  return {{"n", metric.n},
          {"truths", metric.num_truth},
          {"distance_m", number(metric.distance_m)},
          {"jaccard", number(metric.jaccard)}};
}

Json json_of(const OneToOneMetric& metric) {
  return {{"truths", metric.num_truth},
          {"objects", metric.num_map},
          {"matched", metric.matched},
          {"excluded", metric.excluded},
          {"duplicates", metric.duplicates},
          {"precision", number(metric.precision)},
          {"recall", number(metric.recall)},
          {"f1", number(metric.f1)},
          {"distance_m", number(metric.distance_m)},
          {"jaccard_in_place", number(metric.jaccard_in_place)},
          {"judged", metric.num_judged},
          {"small_jaccard_in_place", number(metric.small_jaccard_in_place)},
          {"small", metric.num_small}};
}

void print_json(const EvaluationOutcome& outcome) {
  Json json{{"all", json_of(outcome.report.all.nearest)},
            {"one_to_one", json_of(outcome.report.all.one_to_one)},
            {"classes", Json::object()}};
  for (const auto& [name, metrics] : outcome.report.classes) {
    json["classes"][name] = {{"all", json_of(metrics.nearest)},
                             {"one_to_one", json_of(metrics.one_to_one)}};
  }
  if (outcome.against) {
    json["against"] = {{"p_jaccard_greater", number(outcome.against->jaccard.p)},
                       {"p_distance_smaller", number(outcome.against->distance.p)}};
  }
  std::printf("%s\n", json.dump(2).c_str());
}

std::vector<std::string> row(const std::string& name, const ClassMetrics& metrics) {
  const OneToOneMetric& one = metrics.one_to_one;
  return {printable(name),
          std::to_string(one.num_truth),
          std::to_string(one.num_map),
          fixed(one.precision, 2),
          fixed(one.recall, 2),
          fixed(one.f1, 2),
          fixed(one.distance_m, 3),
          fixed(one.jaccard_in_place, 2),
          std::to_string(one.duplicates),
          fixed(metrics.nearest.distance_m, 3),
          fixed(metrics.nearest.jaccard, 2)};
}

void print_table(const EvaluationOutcome& outcome) {
  Table table({"class",
               "truths",
               "found",
               "precision",
               "recall",
               "F1",
               "distance m",
               "Jaccard",
               "duplicates",
               "thesis: distance m",
               "thesis: Jaccard"});
  for (const auto& [name, metrics] : outcome.report.classes) table.add(row(name, metrics));
  table.add(row("all", outcome.report.all));
  std::printf("%s", table.text().c_str());
  const OneToOneMetric& one = outcome.report.all.one_to_one;
  std::printf(
      "%zu true objects excluded; Jaccard in place over %zu footprints of %.2f m2 and more\n",
      one.excluded,
      one.num_judged,
      EvaluationOptions{}.min_judged_area_m2);
  if (!outcome.against) return;
  std::printf(
      "against the other map (Wilcoxon, one-sided): p = %s that this map's Jaccard is greater "
      "by chance, p = %s that its distance is smaller by chance\n",
      fixed(outcome.against->jaccard.p, 4).c_str(),
      fixed(outcome.against->distance.p, 4).c_str());
}

}  // namespace

void add_eval_command(CLI::App& program, Action& action) {
  auto arguments = std::make_shared<EvalArguments>();
  CLI::App& command =
      *program.add_subcommand("eval", "How good a map is, measured against a truth");
  command.add_option("--map", arguments->map, "archive to evaluate")->required();
  command.add_option("--truth", arguments->truth, "archive that is right")->required();
  command.add_option("--against", arguments->against, "another map of the same place, to compare");
  command.add_option("--layer", arguments->layer, "semantic layer in each")->capture_default_str();
  command.add_option("--classes", arguments->classes, "only these, separated by commas")
      ->delimiter(',');
  command.add_flag("--json", arguments->json, "one JSON document");
  arguments->load.add_to(command);
  show_examples(command, {"hypermap eval --map lab.hmap --truth lab/truth.hmap"});
  command.callback([arguments, &action] {
    action = [arguments] {
      auto outcome = run_evaluation(job_of(*arguments));
      if (!outcome) {
        if (outcome.error().field == "classes") outcome.error().field = "--classes";
        return report(outcome.error());
      }
      if (arguments->json) {
        print_json(*outcome);
      } else {
        print_table(*outcome);
      }
      return ExitCode::kDone;
    };
  });
}

}  // namespace hypermap::app

// SPDX-License-Identifier: BSD-3-Clause
#include "command.hpp"
#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/evaluation/map_evaluation.hpp"
#include "hypermap/core/evaluation/wilcoxon.hpp"
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/projection/layers/evaluated_objects.hpp"
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
};

/// Two maps compared by the truths that both were asked for.
struct Comparison {
  WilcoxonResult jaccard;   ///< That the first map's footprints are better.
  WilcoxonResult distance;  ///< That the first map's centroids are nearer.
};

struct Outcome {
  EvaluationReport report;
  std::optional<Comparison> against;
};

Result<std::vector<EvaluatedObject>> objects_of(const std::string& path, const std::string& layer) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto loaded, load_archive(path));
  const auto found = loaded.value.hypermap.at(layer);
  if (!found) return Unexpected(with_source(found.error(), {path}));
  const auto* semantic = (*found)->content.as<SemanticLayer>();
  if (semantic == nullptr) {
    return Unexpected(Error{ErrorCode::kUnsupported, "is no semantic layer", path, layer});
  }
  return evaluated_objects(*semantic);
}

Result<Comparison> compare(const EvaluationReport& first, const EvaluationReport& second) {
  std::vector<double> first_jaccard;
  std::vector<double> second_jaccard;
  std::vector<double> first_distance;
  std::vector<double> second_distance;
  for (std::size_t i = 0; i < first.truths.size(); ++i) {
    const TruthResult& a = first.truths[i];
    const TruthResult& b = second.truths[i];
    if (!a.nearest_map_index || !b.nearest_map_index) continue;
    first_jaccard.push_back(a.aligned_jaccard);
    second_jaccard.push_back(b.aligned_jaccard);
    first_distance.push_back(a.nearest_distance_m);
    second_distance.push_back(b.nearest_distance_m);
  }
  // One-sided: is the first map's Jaccard index greater, is the second map's distance greater?
  HYPERMAP_ASSIGN_OR_RETURN(const auto jaccard, wilcoxon_one_sided(first_jaccard, second_jaccard));
  HYPERMAP_ASSIGN_OR_RETURN(const auto distance,
                            wilcoxon_one_sided(second_distance, first_distance));
  return Comparison{jaccard, distance};
}

Result<Outcome> run(const EvalArguments& arguments) {
  EvaluationOptions options;
  options.classes = arguments.classes;
  HYPERMAP_ASSIGN_OR_RETURN(const auto truth, objects_of(arguments.truth, arguments.layer));
  HYPERMAP_ASSIGN_OR_RETURN(const auto map, objects_of(arguments.map, arguments.layer));
  Outcome outcome{.report = evaluate(map, truth, options), .against = std::nullopt};
  for (const std::string& name : arguments.classes) {
    if (outcome.report.classes.contains(canonical_class_name(name))) continue;
    return fail(ErrorCode::kNotFound,
                "neither the map nor the truth has an object of class '" + printable(name) + "'",
                "--classes");
  }
  if (arguments.against) {
    HYPERMAP_ASSIGN_OR_RETURN(const auto other, objects_of(*arguments.against, arguments.layer));
    HYPERMAP_ASSIGN_OR_RETURN(outcome.against,
                              compare(outcome.report, evaluate(other, truth, options)));
  }
  return outcome;
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

void print_json(const Outcome& outcome) {
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

void print_table(const Outcome& outcome) {
  Table table({"class",
               "truths",
               "found",
               "precision",
               "recall",
               "F1",
               "distance m",
               "Jaccard",
               "twice",
               "text: distance m",
               "text: Jaccard"});
  for (const auto& [name, metrics] : outcome.report.classes) table.add(row(name, metrics));
  table.add(row("all", outcome.report.all));
  std::printf("%s", table.text().c_str());
  const OneToOneMetric& one = outcome.report.all.one_to_one;
  std::printf(
      "%zu true objects excluded; Jaccard in place over %zu footprints of 0.04 m2 and more\n",
      one.excluded,
      one.num_judged);
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
  command.add_option("--map", arguments->map, "archive to judge")->required();
  command.add_option("--truth", arguments->truth, "archive that is right")->required();
  command.add_option("--against", arguments->against, "another map of the same place, to compare");
  command.add_option("--layer", arguments->layer, "semantic layer in each")->capture_default_str();
  command.add_option("--classes", arguments->classes, "only these, separated by commas")
      ->delimiter(',');
  command.add_flag("--json", arguments->json, "one JSON document");
  command.callback([arguments, &action] {
    action = [arguments] {
      const auto outcome = run(*arguments);
      if (!outcome) return report(outcome.error());
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

// SPDX-License-Identifier: BSD-3-Clause
#include "rates_texts.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>

namespace hypermap::app {
namespace {

using RatesJson = nlohmann::ordered_json;

template <class T>
RatesJson known(const std::optional<T>& value) {
  return value ? RatesJson(*value) : RatesJson(nullptr);
}

RatesJson known(const std::optional<Eigen::Vector3d>& vector) {
  if (!vector) return nullptr;
  return {vector->x(), vector->y(), vector->z()};
}

RatesJson json_of(const PositionErrorSummary& errors) {
  return {{"n", errors.n},
          {"mean_m", known(errors.mean_m)},
          {"distance_m", known(errors.mean_distance_m)},
          {"std_distance_m", known(errors.std_distance_m)},
          {"rmse_xyz_m", known(errors.rmse_m)},
          {"rmse_m", known(errors.total_rmse_m)}};
}

RatesJson json_of(const RateRow& row, const char* precision_key) {
  const BinaryCounts& counts = row.counts;
  RatesJson precisions = RatesJson::object();
  for (const MatchCriterion criterion : kMatchCriteria)
    precisions[std::string(key_of(criterion))] =
        known(row.average_precision[static_cast<std::size_t>(criterion)]);
  return {{"things", counts.true_positives + counts.false_negatives},
          {"tp", counts.true_positives},
          {"fp", counts.false_positives},
          {"fn", counts.false_negatives},
          {"tn", known(counts.true_negatives)},
          {"tpr", known(counts.true_positive_rate())},
          {"tnr", known(counts.true_negative_rate())},
          {"fpr", known(counts.false_positive_rate())},
          {"fnr", known(counts.false_negative_rate())},
          {"accuracy", known(counts.accuracy())},
          {"precision", known(counts.precision())},
          {"f1", known(counts.f1())},
          {precision_key, std::move(precisions)},
          {"box_iou", known(row.box_iou)},
          {"position", json_of(row.position)}};
}

RatesJson json_of(const Classifications& classes) {
  return {{"objects", classes.num_all},
          {"right", classes.num_right},
          {"accuracy", known(classes.accuracy())}};
}

RatesJson json_of(const TruthRun& instance) {
  return {{"thing", instance.reference},
          {"class", instance.class_name},
          {"counts", instance.counts},
          {"object", known(instance.object_id)},
          {"true_position", known(instance.true_centre)},
          {"position", known(instance.centre)},
          {"error_m", known(instance.error_m)},
          {"box_iou", known(instance.overlap)}};
}

RatesJson json_of(const FalseObject& object) {
  return {{"object", object.object_id},
          {"class", object.class_name},
          {"position", known(std::optional(object.place))},
          {"confidence", known(object.confidence)}};
}

RatesJson json_of(const ObjectRow& row) {
  return {{"thing", row.reference},
          {"class", row.class_name},
          {"runs", row.num_counting},
          {"found", row.num_found},
          {"position", json_of(row.position)}};
}

RatesJson json_of(const std::vector<PrecisionRecallPoint>& curve) {
  RatesJson points = RatesJson::array();
  for (const PrecisionRecallPoint& point : curve)
    points.push_back({{"confidence", point.probability},
                      {"precision", point.precision},
                      {"recall", point.recall}});
  return points;
}

RatesJson json_of(const RunFit& fit) {
  return {{"jaccard_in_place", known(fit.jaccard_in_place)},
          {"label_precision", known(fit.label_precision)},
          {"label_recall", known(fit.label_recall)}};
}

RatesJson json_of(const OverRuns& over_runs) {
  RatesJson interval = nullptr;
  if (over_runs.half_width_95) interval = {*over_runs.low_95(), *over_runs.high_95()};
  return {{"n", over_runs.n},
          {"mean", known(over_runs.mean)},
          {"std", known(over_runs.std)},
          {"interval_95", std::move(interval)}};
}

}  // namespace

std::vector<RunName> run_names(const RatesJob& job) {
  std::vector<RunName> names;
  names.reserve(job.maps.size());
  for (std::size_t i = 0; i < job.maps.size(); ++i) {
    const auto& truth = job.truths[std::min(i, job.truths.size() - 1)];
    names.push_back({job.maps[i].filename().string(), truth.filename().string()});
  }
  return names;
}

std::string json_text_of(const RatesOutcome& outcome, const std::vector<RunName>& names) {
  const RunTables& tables = outcome.tables;
  RatesJson json{{"all", json_of(tables.all, "mean_ap")},
                 {"classification", json_of(tables.classifications)},
                 {"classes", RatesJson::object()},
                 {"runs", RatesJson::array()},
                 {"over_runs", RatesJson::object()},
                 {"things", RatesJson::array()},
                 {"mean_errors", json_of(tables.mean_errors)},
                 {"unknown", outcome.unknown}};
  for (const auto& [name, row] : tables.classes) {
    json["classes"][name] = json_of(row.rates, "ap");
    json["classes"][name]["curve"] = json_of(row.curve);
  }
  for (std::size_t i = 0; i < tables.runs.size(); ++i) {
    RatesJson run{{"map", names[i].map}, {"truth", names[i].truth}};
    run.update(json_of(tables.runs[i], "mean_ap"));
    run["classification"] = json_of(tables.run_classifications[i]);
    run["fit"] = json_of(tables.run_fits[i]);
    run["things_found"] = RatesJson::array();
    for (const TruthRun& instance : outcome.runs[i].truths)
      run["things_found"].push_back(json_of(instance));
    run["false"] = RatesJson::array();
    for (const FalseObject& object : outcome.runs[i].false_objects)
      run["false"].push_back(json_of(object));
    json["runs"].push_back(std::move(run));
  }
  for (const RunFigure& figure : tables.figures)
    json["over_runs"][figure.key] = json_of(figure.over_runs);
  for (const ObjectRow& row : tables.objects) json["things"].push_back(json_of(row));
  return json.dump(2, ' ', false, RatesJson::error_handler_t::replace) + "\n";
}

}  // namespace hypermap::app

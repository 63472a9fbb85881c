// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation_texts.hpp"
#include "json_numbers.hpp"
#include "voxel_texts.hpp"

#include <nlohmann/json.hpp>

namespace hypermap::app {
namespace {

using EvaluationJson = nlohmann::ordered_json;

EvaluationJson json_of(const NearestMetric& metric) {
  return {{"n", metric.n},
          {"truths", metric.num_truth},
          {"distance_m", number_json(metric.distance_m)},
          {"jaccard", number_json(metric.jaccard)}};
}

EvaluationJson json_of(const OneToOneMetric& metric) {
  return {{"truths", metric.num_truth},
          {"objects", metric.num_map},
          {"matched", metric.matched},
          {"excluded", metric.excluded},
          {"rarely_seen", metric.rarely_seen},
          {"duplicates", metric.duplicates},
          {"precision", number_json(metric.precision)},
          {"recall", number_json(metric.recall)},
          {"f1", number_json(metric.f1)},
          {"distance_m", number_json(metric.distance_m)},
          {"jaccard_in_place", number_json(metric.jaccard_in_place)},
          {"worst_jaccard_in_place", number_json(metric.worst_jaccard_in_place)},
          {"judged", metric.num_judged},
          {"small_jaccard_in_place", number_json(metric.small_jaccard_in_place)},
          {"small", metric.num_small},
          {"seen_jaccard_in_place", number_json(metric.seen_jaccard_in_place)},
          {"seen", metric.num_seen},
          {"footprint_covered", number_json(metric.footprint_covered)},
          {"box_iou", number_json(metric.box_iou)},
          {"boxes", metric.num_boxes}};
}

EvaluationJson json_of(const VoxelOutcome& outcome) {
  EvaluationJson json = voxel_json(outcome.labels.all);
  json["wrong_class_share"] = number_json(outcome.labels.all.wrong_class_share());
  json["surface_covered"] = number_json(outcome.surface_covered);
  json["classes"] = EvaluationJson::object();
  for (const auto& [name, counts] : outcome.labels.classes) {
    json["classes"][name] = voxel_json(counts);
  }
  return json;
}

EvaluationJson json_of(const GridAgreement& grid) {
  return {{"free", grid.free},
          {"free_right", grid.free_right},
          {"free_precision", number_json(grid.free_precision())},
          {"true_free", grid.true_free},
          {"free_found", grid.free_found},
          {"free_recall", number_json(grid.free_recall())},
          {"occupied", grid.occupied},
          {"occupied_right", grid.occupied_right},
          {"occupied_precision", number_json(grid.occupied_precision())},
          {"true_occupied", grid.true_occupied},
          {"occupied_found", grid.occupied_found},
          {"occupied_recall", number_json(grid.occupied_recall())},
          {"occupied_free", grid.occupied_free}};
}

EvaluationJson json_of(const RelationEvaluation& relations) {
  EvaluationJson json = EvaluationJson::object();
  for (const RelationKind kind : kRelationKinds) {
    const RelationCounts& counts = relations.of(kind);
    json[std::string(key_of(kind))] = {{"right", counts.right},
                                       {"map", counts.num_map},
                                       {"truth", counts.num_truth},
                                       {"precision", number_json(counts.precision())},
                                       {"recall", number_json(counts.recall())}};
  }
  return json;
}

EvaluationJson json_of(const CalibrationReport& report) {
  EvaluationJson bins = EvaluationJson::array();
  for (const CalibrationBin& bin : report.bins) {
    bins.push_back(
        {{"n", bin.n}, {"mean_probability", bin.mean_probability}, {"true_share", bin.true_share}});
  }
  EvaluationJson interval = nullptr;
  if (report.expected_error) interval = {report.error_low, report.error_high};
  return {{"n", report.n},
          {"expected_error", number_json(report.expected_error)},
          {"interval_95", std::move(interval)},
          {"log_loss", number_json(report.log_loss)},
          {"bins", std::move(bins)}};
}

EvaluationJson json_of(const ObjectOutcome& object) {
  EvaluationJson truth = nullptr;
  if (object.true_id) truth = {{"id", *object.true_id}, {"class", object.true_class_name}};
  return {{"id", object.id},
          {"class", object.class_name},
          {"confirmed", object.is_confirmed},
          {"real_probability", object.real_probability},
          {"class_probability", object.best_class_probability},
          {"truth", std::move(truth)}};
}

EvaluationJson json_of(const TrueObjectOutcome& truth) {
  return {
      {"id", truth.id},
      {"class", truth.class_name},
      {"counts", truth.counts},
      {"matched", truth.matched_id ? EvaluationJson(*truth.matched_id) : EvaluationJson(nullptr)},
      {"distance_m", number_json(truth.distance_m)},
      {"jaccard_in_place", truth.jaccard_in_place},
      {"box_iou", number_json(truth.box_iou)},
      {"off_height_m", number_json(truth.off_height_m)},
      {"thesis",
       {{"distance_m", number_json(truth.nearest_distance_m)},
        {"jaccard", number_json(truth.aligned_jaccard)}}}};
}

}  // namespace

std::string json_text_of(const EvaluationOutcome& outcome) {
  EvaluationJson json{{"all", json_of(outcome.report.all.nearest)},
                      {"one_to_one", json_of(outcome.report.all.one_to_one)},
                      {"classes", EvaluationJson::object()},
                      {"knows_frames_named", outcome.knows_frames_named}};
  for (const auto& [name, metrics] : outcome.report.classes) {
    json["classes"][name] = {{"all", json_of(metrics.nearest)},
                             {"one_to_one", json_of(metrics.one_to_one)}};
  }
  json["voxels"] = outcome.voxels ? json_of(*outcome.voxels) : EvaluationJson(nullptr);
  if (!outcome.voxels) json["why_no_voxels"] = outcome.why_no_voxels;
  json["occupancy"] = outcome.occupancy ? json_of(*outcome.occupancy) : EvaluationJson(nullptr);
  json["relations"] = outcome.relations ? json_of(*outcome.relations) : EvaluationJson(nullptr);
  json["calibration"] = {{"best_class", json_of(outcome.best_class)},
                         {"real", json_of(outcome.real)}};
  json["truths"] = EvaluationJson::array();
  for (const TrueObjectOutcome& truth : outcome.truths) json["truths"].push_back(json_of(truth));
  json["objects"] = EvaluationJson::array();
  for (const ObjectOutcome& object : outcome.objects) json["objects"].push_back(json_of(object));
  if (outcome.against) {
    json["against"] = {{"p_jaccard_greater", number_json(outcome.against->jaccard.p)},
                       {"p_distance_smaller", number_json(outcome.against->distance.p)}};
  }
  return json.dump(2) + "\n";
}

}  // namespace hypermap::app

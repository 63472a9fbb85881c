// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/evaluation_job.hpp"

#include "evaluated_archive.hpp"
#include "evaluated_relations.hpp"
#include "evaluated_voxels.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

EvaluatedSource source_of(const EvaluationJob& job) {
  return {.layer = job.layer, .limits = job.limits, .stop = job.stop};
}

void add_to(std::vector<Prediction>& predictions, const std::vector<Prediction>& more) {
  predictions.insert(predictions.end(), more.begin(), more.end());
}

/// The predictions of the map, and those of the further pairs behind them.
Result<ObjectPredictions> all_predictions(std::span<const BelievedObject> believed,
                                          const EvaluatedArchive& truth,
                                          const EvaluationOptions& options,
                                          const EvaluationJob& job) {
  ObjectPredictions all = object_predictions(believed, truth.objects, options);
  for (const MapAndTruth& pair : job.also) {
    HYPERMAP_ASSIGN_OR_RETURN(auto other_truth, load_evaluated(pair.truth, source_of(job)));
    HYPERMAP_ASSIGN_OR_RETURN(auto other_map,
                              load_in_frame(pair.map, source_of(job), other_truth.frame_id));
    understand(other_truth, truth.archive.vocabulary);
    understand(other_map, truth.archive.vocabulary);
    const ObjectPredictions more =
        object_predictions(believed_objects(other_map), other_truth.objects, options);
    add_to(all.real, more.real);
    add_to(all.best_class, more.best_class);
  }
  return all;
}

/// `predictions` are those of `believed` in its order.
std::vector<ObjectOutcome> object_outcomes(std::span<const BelievedObject> believed,
                                           const ObjectPredictions& predictions,
                                           const EvaluatedArchive& truth) {
  std::vector<ObjectOutcome> outcomes;
  outcomes.reserve(believed.size());
  for (std::size_t i = 0; i < believed.size(); ++i) {
    const BelievedObject& object = believed[i];
    ObjectOutcome& outcome = outcomes.emplace_back(
        ObjectOutcome{.id = object.id,
                      .class_name = object.shape.class_name,
                      .is_confirmed = object.is_confirmed,
                      .real_probability = object.real_probability,
                      .best_class_probability = object.best_class_probability});
    if (!predictions.truth_of[i]) continue;
    outcome.true_id = truth.ids[*predictions.truth_of[i]];
    outcome.true_class_name = truth.objects[*predictions.truth_of[i]].class_name;
  }
  return outcomes;
}

/// How much higher the middle of the map's box lies.
std::optional<double> off_height_m(const EvaluatedObject& found, const EvaluatedObject& truth) {
  if (!found.box || !truth.box) return std::nullopt;
  return found.box->centre().z() - truth.box->centre().z();
}

std::vector<TrueObjectOutcome> true_object_outcomes(const EvaluationReport& report,
                                                    const EvaluatedArchive& map,
                                                    const EvaluatedArchive& truth) {
  std::vector<TrueObjectOutcome> outcomes;
  outcomes.reserve(report.truths.size());
  for (const TruthResult& result : report.truths) {
    const EvaluatedObject& object = truth.objects[result.truth_index];
    TrueObjectOutcome& outcome =
        outcomes.emplace_back(TrueObjectOutcome{.id = truth.ids[result.truth_index],
                                                .class_name = object.class_name,
                                                .counts = !object.excluded,
                                                .jaccard_in_place = result.jaccard_in_place,
                                                .box_iou = result.box_iou});
    if (const auto matched = result.matched_map_index) {
      outcome.matched_id = map.ids[*matched];
      outcome.distance_m = result.matched_distance_m;
      outcome.off_height_m = off_height_m(map.objects[*matched], object);
    }
    if (!result.nearest_map_index) continue;
    outcome.nearest_distance_m = result.nearest_distance_m;
    outcome.aligned_jaccard = result.aligned_jaccard;
  }
  return outcomes;
}

std::optional<GridAgreement> occupancy_agreement(const Hypermap& map, const Hypermap& truth) {
  const Layer* found = map.find(kOccupancyLayer);
  const Layer* true_layer = truth.find(kOccupancyLayer);
  if (found == nullptr || true_layer == nullptr) return std::nullopt;
  const auto* grid = map.find_as<OccupancyLayer>(kOccupancyLayer);
  const auto* true_grid = truth.find_as<OccupancyLayer>(kOccupancyLayer);
  const bool are_alike =
      grid != nullptr && true_grid != nullptr && found->info.frame_id == true_layer->info.frame_id;
  if (!are_alike) return std::nullopt;
  return grid_agreement(grid->grid, true_grid->grid);
}

bool knows_frames_named(const std::vector<EvaluatedObject>& truth) {
  return !truth.empty() && std::all_of(truth.begin(), truth.end(), [](const auto& object) {
    return object.frames_named.has_value();
  });
}

}  // namespace

Result<EvaluationOutcome> run_evaluation(const EvaluationJob& job) {
  HYPERMAP_TRY(validate(job.options));
  HYPERMAP_TRY(validate(job.calibration));
  HYPERMAP_ASSIGN_OR_RETURN(auto truth, load_evaluated(job.truth, source_of(job)));
  HYPERMAP_ASSIGN_OR_RETURN(auto map, load_in_frame(job.map, source_of(job), truth.frame_id));
  const ClassVocabulary vocabulary = vocabulary_of(job.vocabulary, map.archive, truth.archive);
  understand(map, vocabulary);
  understand(truth, vocabulary);
  HYPERMAP_ASSIGN_OR_RETURN(const EvaluationOptions options,
                            understood_options(job.options, map, truth));
  EvaluationOutcome outcome{.report = evaluate(map.objects, truth.objects, options),
                            .knows_frames_named = knows_frames_named(truth.objects)};
  outcome.truths = true_object_outcomes(outcome.report, map, truth);
  outcome.plan =
      compared_plan({map.objects, map.ids}, {truth.objects, truth.ids}, outcome.report, options);
  outcome.why_no_voxels = why_no_voxels(map.archive, truth.archive);
  if (outcome.why_no_voxels.empty()) {
    HYPERMAP_ASSIGN_OR_RETURN(outcome.voxels, evaluated_voxels(map, truth, job.stop));
  }
  outcome.occupancy = occupancy_agreement(map.archive.hypermap, truth.archive.hypermap);
  outcome.relations = evaluated_relations(map, truth, outcome.report);
  const std::vector<BelievedObject> believed = believed_objects(map);
  HYPERMAP_ASSIGN_OR_RETURN(const ObjectPredictions predictions,
                            all_predictions(believed, truth, options, job));
  outcome.best_class = calibration(predictions.best_class, job.calibration);
  outcome.real = calibration(predictions.real, job.calibration);
  outcome.objects = object_outcomes(believed, predictions, truth);
  if (job.against) {
    HYPERMAP_ASSIGN_OR_RETURN(auto other,
                              load_in_frame(*job.against, source_of(job), truth.frame_id));
    understand(other, vocabulary);
    HYPERMAP_ASSIGN_OR_RETURN(
        outcome.against, compare(outcome.report, evaluate(other.objects, truth.objects, options)));
  }
  return outcome;
}

}  // namespace hypermap

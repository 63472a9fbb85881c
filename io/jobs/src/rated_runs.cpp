// SPDX-License-Identifier: BSD-3-Clause
#include "rated_runs.hpp"

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/evaluation/match_gate.hpp"
#include "hypermap/core/objects/object_outline.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace hypermap {
namespace {

std::optional<TurnedBox> shown_box_of(const EvaluatedObject& object) {
  if (!object.box) return std::nullopt;
  const auto hull = convex_hull(object.footprint.outer);
  return turned_box_around(hull ? hull->outer : object.footprint.outer,
                           object.box->min_in_map.z(),
                           object.box->max_in_map.z());
}

std::optional<Eigen::Vector3d> centre_of(const std::optional<Box>& box) {
  if (!box) return std::nullopt;
  return box->centre();
}

/// Where distances are measured in the plan alone.
Eigen::Vector3d place_in_plan(const Eigen::Vector2d& centroid) {
  return {centroid.x(), centroid.y(), 0.0};
}

using BeliefById = std::map<std::uint64_t, BelievedObject>;

BeliefById beliefs_of(const std::vector<BelievedObject>& believed) {
  BeliefById by_id;
  for (const BelievedObject& object : believed) by_id.emplace(object.id, object);
  return by_id;
}

double confidence_of(const BelievedObject& object) {
  return object.real_probability * object.best_class_probability;
}

/// The objects of the layer in its order, apart until told otherwise.
std::vector<RatedObject> confirmed_objects_of(const EvaluatedArchive& map,
                                              const BeliefById& beliefs) {
  std::vector<RatedObject> objects;
  objects.reserve(map.objects.size());
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    const EvaluatedObject& shown = map.objects[i];
    RatedObject& object =
        objects.emplace_back(RatedObject{.id = map.ids[i],
                                         .class_name = canonical_class_name(shown.class_name),
                                         .place = place_in_plan(shown.centroid),
                                         .centre = centre_of(shown.box),
                                         .box = shown_box_of(shown),
                                         .is_apart = true});
    const auto belief = beliefs.find(map.ids[i]);
    if (belief != beliefs.end()) object.confidence = confidence_of(belief->second);
  }
  return objects;
}

void add_tentative_objects(const EvaluatedArchive& map,
                           const BeliefById& beliefs,
                           std::vector<RatedObject>& objects) {
  for (const auto& [id, belief] : beliefs) {
    if (belief.is_confirmed) continue;
    const Object* object = map.archive.objects.find(ObjectId{static_cast<std::uint32_t>(id)});
    objects.push_back({.id = id,
                       .class_name = canonical_class_name(belief.shape.class_name),
                       .place = place_in_plan(belief.shape.centroid),
                       .centre = object->box.centre(),
                       .box = turned_box_of(*object),
                       .is_confirmed = false,
                       .confidence = confidence_of(belief)});
  }
}

/// A map that shows objects and keeps none was not made here: what it rejected is not known.
bool keeps_tentative(const EvaluatedArchive& map) {
  return map.objects.empty() || !map.archive.objects.empty();
}

std::vector<RatedTruth> rated_truths(const EvaluatedArchive& truth,
                                     const EvaluationOptions& options) {
  std::vector<RatedTruth> truths;
  truths.reserve(truth.objects.size());
  for (std::size_t t = 0; t < truth.objects.size(); ++t) {
    const EvaluatedObject& object = truth.objects[t];
    truths.push_back({.reference = std::to_string(truth.ids[t]),
                      .class_names = {canonical_class_name(object.class_name)},
                      .place = place_in_plan(object.centroid),
                      .gate_m = match_gate_m(object, options),
                      .centre = centre_of(object.box),
                      .box = shown_box_of(object),
                      .counts = !object.excluded});
  }
  return truths;
}

void keep_classes(const std::vector<std::string>& names, RatedRun& run) {
  if (names.empty()) return;
  std::set<std::string> chosen;
  for (const std::string& name : names) chosen.insert(canonical_class_name(name));
  std::vector<std::size_t> place_of(run.objects.size(), 0);
  std::vector<RatedObject> kept;
  for (std::size_t o = 0; o < run.objects.size(); ++o) {
    place_of[o] = kept.size();
    if (chosen.contains(run.objects[o].class_name)) kept.push_back(std::move(run.objects[o]));
  }
  run.objects = std::move(kept);
  std::erase_if(run.truths, [&](const RatedTruth& truth) {
    return !chosen.contains(truth.class_names.front());
  });
  for (RatedTruth& truth : run.truths) {
    if (truth.object) truth.object = place_of[*truth.object];
  }
}

Classifications classified(const std::vector<Prediction>& best_class) {
  const auto num_right = std::count_if(
      best_class.begin(), best_class.end(), [](const Prediction& one) { return one.is_true; });
  return {.num_all = best_class.size(), .num_right = static_cast<std::size_t>(num_right)};
}

/// Canonical, none twice, in their order.
std::vector<std::string> canonical_names(const std::vector<std::string>& names) {
  std::vector<std::string> canonical;
  for (const std::string& name : names) {
    std::string one = canonical_class_name(name);
    if (std::find(canonical.begin(), canonical.end(), one) == canonical.end())
      canonical.push_back(std::move(one));
  }
  return canonical;
}

RatedTruth rated_truth(const ListedEvaluation& evaluation,
                       std::size_t t,
                       const InstanceComparisonOptions& options) {
  const ListedInstance& instance = evaluation.listed.instances[t];
  const ComparedInstance& compared = evaluation.instances[t];
  const bool counts = compared.standing == InstanceStanding::kCounts;
  return {
      .reference = instance.name,
      .class_names = canonical_names(instance.class_names),
      .place = compared.box.centre(),
      .gate_m = instance_reach_m(compared.box, options),
      .centre = compared.box.centre(),
      .box = turned_box_in_map(instance, evaluation.listed.up_in_input, evaluation.map_from_input),
      .counts = counts,
      .object = counts ? evaluation.comparison.instances[t].object : std::nullopt};
}

}  // namespace

RatedRun rated_run(const EvaluatedArchive& map,
                   const EvaluatedArchive& truth,
                   const EvaluationOptions& options) {
  const EvaluationReport report = evaluate(map.objects, truth.objects, options);
  const std::vector<BelievedObject> believed = believed_objects(map);
  const BeliefById beliefs = beliefs_of(believed);
  const auto predictions = object_predictions(believed, truth.objects, options);
  RatedRun run{.objects = confirmed_objects_of(map, beliefs),
               .truths = rated_truths(truth, options),
               .classifications = classified(predictions.best_class),
               .has_tentative = keeps_tentative(map),
               .fit = {.jaccard_in_place = report.all.one_to_one.jaccard_in_place}};
  for (const TruthResult& result : report.truths) {
    run.truths[result.truth_index].object = result.matched_map_index;
    if (result.matched_map_index) run.objects[*result.matched_map_index].is_apart = false;
  }
  for (const std::size_t o : report.false_positives) run.objects[o].is_apart = false;
  add_tentative_objects(map, beliefs, run.objects);
  keep_classes(options.classes, run);
  return run;
}

RatedRun rated_run(const EvaluatedArchive& map,
                   const ListedEvaluation& evaluation,
                   const InstanceComparisonOptions& options) {
  const BeliefById beliefs = beliefs_of(believed_objects(map));
  const InstanceCounts& counts = evaluation.comparison.counts;
  RatedRun run{
      .objects = confirmed_objects_of(map, beliefs),
      .classifications = {.num_all = counts.found + counts.wrong_class, .num_right = counts.found},
      .has_tentative = keeps_tentative(map)};
  run.truths.reserve(evaluation.instances.size());
  const auto rate = [&run](const std::vector<std::size_t>& objects) {
    for (const std::size_t o : objects) run.objects[o].is_apart = false;
  };
  for (std::size_t t = 0; t < evaluation.instances.size(); ++t) {
    const RatedTruth& truth = run.truths.emplace_back(rated_truth(evaluation, t, options));
    if (!truth.counts) continue;
    const InstanceResult& result = evaluation.comparison.instances[t];
    if (truth.object) rate({*truth.object});
    rate(result.duplicates);
    rate(result.others);
  }
  rate(evaluation.comparison.false_objects);
  add_tentative_objects(map, beliefs, run.objects);
  // The list compares centres of boxes, in space.
  for (RatedObject& object : run.objects) object.place = *object.centre;
  return run;
}

}  // namespace hypermap

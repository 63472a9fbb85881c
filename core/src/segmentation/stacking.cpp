// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/stacking.hpp"

#include "hypermap/core/base/nearest_name.hpp"
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <string>

namespace hypermap {
namespace {

/// The combined set: per class, what each detector that knows it says, already weighted.
using Cells = std::map<ClassId, std::vector<double>>;

double weight_of(DetectorId detector, const StackingOptions& options, const StackingModel& model) {
  if (options.rule != StackingRule::kWeighted) return 1.0;
  const auto found = model.weights.find(detector);
  return found == model.weights.end() ? 1.0 : found->second;
}

Cells combined_set(std::span<const std::vector<ClassEvidence>> likelihoods,
                   std::span<const DetectorId> detectors,
                   const StackingOptions& options,
                   const StackingModel& model) {
  Cells cells;
  for (std::size_t i = 0; i < likelihoods.size(); ++i) {
    const double weight = weight_of(detectors[i], options, model);
    for (const ClassEvidence& evidence : likelihoods[i]) {
      cells[evidence.id].push_back(weight * evidence.probability.value());
    }
  }
  return cells;
}

double sum_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double product_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 1.0, std::multiplies<>());
}

/// Each cell made one number by `combine`, scaled to sum 1; empty when all are 0.
template <class Combine>
std::vector<ClassEvidence> normalised_cells(const Cells& cells, Combine combine) {
  double total = 0.0;
  for (const auto& [id, values] : cells) total += combine(values);
  std::vector<ClassEvidence> out;
  if (!(total > 0.0)) return out;
  for (const auto& [id, values] : cells) {
    out.push_back({id, Probability(std::min(1.0, combine(values) / total))});
  }
  return out;
}

/// Detections of one object, best score first; at most one of each detector.
using Group = std::vector<const Detection*>;

bool has_detector(const Group& group, DetectorId detector) {
  return std::any_of(group.begin(), group.end(), [&](const Detection* member) {
    return member->detector == detector;
  });
}

PixelBox mean_box(const Group& group) {
  double total = 0.0;
  for (const Detection* member : group) total += member->score.value();
  PixelBox mean;
  for (const Detection* member : group) {
    const double share =
        total > 0.0 ? member->score.value() / total : 1.0 / static_cast<double>(group.size());
    mean.u_min_px += share * member->box_px.u_min_px;
    mean.v_min_px += share * member->box_px.v_min_px;
    mean.u_max_px += share * member->box_px.u_max_px;
    mean.v_max_px += share * member->box_px.v_max_px;
  }
  return mean;
}

std::optional<MaskImage> united_mask(const Group& group) {
  std::optional<MaskImage> mask;
  for (const Detection* member : group) {
    if (!member->mask) continue;
    if (!mask) {
      mask = member->mask;
      continue;
    }
    if (mask->width_px() != member->mask->width_px() || mask->size() != member->mask->size()) {
      continue;
    }
    const auto pixels = mask->pixels();
    const auto others = member->mask->pixels();
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      pixels[i] = pixels[i] != 0 || others[i] != 0 ? 1 : 0;
    }
  }
  return mask;
}

/// Of each model that of the first member which has one.
std::vector<Embedding> embeddings_of(const Group& group) {
  std::vector<Embedding> out;
  for (const Detection* member : group) {
    for (const Embedding& embedding : member->embeddings) {
      const bool is_known = std::ranges::find(out, embedding.model, &Embedding::model) != out.end();
      if (!is_known && out.size() < kMaxEmbeddingModels) out.push_back(embedding);
    }
  }
  return out;
}

/// Who named it what all of them together do: of several the one of the best score, of none the
/// first.
DetectorId detector_of(const Group& group, const std::vector<ClassEvidence>& combined) {
  const auto named = best_class(combined);
  for (const Detection* member : group) {
    const auto own = best_class(member->class_scores);
    if (named && own && own->id == named->id) return member->detector;
  }
  return group.front()->detector;
}

Result<Detection> join(const Group& group,
                       const StackingOptions& options,
                       const StackingModel& model) {
  std::vector<std::vector<ClassEvidence>> likelihoods;
  std::vector<DetectorId> detectors;
  for (const Detection* member : group) {
    likelihoods.push_back(member->class_scores);
    detectors.push_back(member->detector);
  }
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<ClassEvidence> scores,
                            combine_class_scores(likelihoods, detectors, options, model));
  if (group.size() == 1) {
    Detection alone = *group.front();
    alone.class_scores = std::move(scores);
    return alone;
  }
  const DetectorId detector = detector_of(group, scores);
  return Detection{.box_px = mean_box(group),
                   .class_scores = std::move(scores),
                   .score = group.front()->score,
                   .detector = detector,
                   .mask = united_mask(group),
                   .embeddings = embeddings_of(group)};
}

constexpr std::string_view kStackingNames[] = {"sum", "product", "weighted", "trained"};

constexpr OptionRow kStackingRows[] = {
    option::choice<&StackingOptions::rule>(
        "rule",
        kStackingNames,
        {.source = "[smap] 3.5.3", .effect = "How class scores of several detectors become one."}),
    option::named_numbers<&StackingOptions::weights>(
        "weights",
        {1e-6, 1e6},
        {.source = "[smap] 3.5.3",
         .effect = "How much a detector counts by rule weighted, else 1."}),
    option::number<&StackingOptions::min_overlap>(
        "min_overlap",
        option::above(0, 1),
        {.effect = "Boxes that overlap so much show the same thing."}),
};

}  // namespace

const OptionTable& option_table(const StackingOptions&) {
  static constexpr OptionTable kTable{kStackingRows};
  return kTable;
}

Result<void> validate(const StackingOptions& options) {
  return check_options(options);
}

StackingModel stacking_model(const StackingOptions& options, const DetectorRegistry& detectors) {
  StackingModel model;
  for (const auto& [name, weight] : options.weights) {
    if (const auto id = detectors.find(name)) model.weights.emplace(*id, weight);
  }
  return model;
}

std::vector<Finding> check_weights(const StackingOptions& options,
                                   const DetectorRegistry& detectors) {
  constexpr const char* kField = "stacking.weights";
  std::vector<Finding> findings;
  if (!options.weights.empty() && options.rule != StackingRule::kWeighted) {
    findings.push_back(
        {.error = {.what = "has no effect unless stacking.rule is weighted", .field = kField}});
  }
  const std::vector<std::string> names = detectors.names();
  for (const NamedNumber& weight : options.weights) {
    if (detectors.find(weight.name)) continue;
    findings.push_back({.error = {.code = ErrorCode::kNotFound,
                                  .what = nothing_named("detector", weight.name, names),
                                  .field = kField}});
  }
  return findings;
}

Result<std::vector<ClassEvidence>> combine_class_scores(
    std::span<const std::vector<ClassEvidence>> likelihoods,
    std::span<const DetectorId> detectors,
    const StackingOptions& options,
    const StackingModel& model) {
  assert(likelihoods.size() == detectors.size());
  if (options.rule == StackingRule::kTrained) {
    if (model.combiner) return model.combiner->combine(likelihoods, detectors);
    return fail(ErrorCode::kInvalidArgument, "is trained, which needs a combiner", "stacking.rule");
  }
  const Cells cells = combined_set(likelihoods, detectors, options, model);
  std::vector<ClassEvidence> combined;
  if (options.rule == StackingRule::kProduct) combined = normalised_cells(cells, product_of);
  if (combined.empty()) combined = normalised_cells(cells, sum_of);
  if (combined.empty()) {
    return fail(ErrorCode::kInvalidArgument, "must have a sum > 0 after weighting", "class_scores");
  }
  return combined;
}

std::vector<std::vector<const Detection*>> group_detections(std::span<const Detection> detections,
                                                            double min_overlap) {
  std::vector<const Detection*> order;
  for (const Detection& detection : detections) order.push_back(&detection);
  std::stable_sort(order.begin(), order.end(), [](const Detection* a, const Detection* b) {
    return a->score > b->score;
  });
  std::vector<Group> groups;
  for (const Detection* detection : order) {
    Group* best = nullptr;
    double best_overlap = 0.0;
    for (Group& group : groups) {
      const double shared = intersection_over_union(group.front()->box_px, detection->box_px);
      if (shared < min_overlap || shared <= best_overlap) continue;
      if (has_detector(group, detection->detector)) continue;
      best = &group;
      best_overlap = shared;
    }
    if (best != nullptr) {
      best->push_back(detection);
    } else {
      groups.push_back({detection});
    }
  }
  return groups;
}

Result<std::vector<Detection>> stack_detections(std::span<const Detection> detections,
                                                const StackingOptions& options,
                                                const StackingModel& model) {
  std::vector<Detection> joined;
  for (const Group& group : group_detections(detections, options.min_overlap)) {
    Result<Detection> one = join(group, options, model);
    if (!one) {
      Error error = std::move(one).error();
      error.entry = "detection " + std::to_string(group.front() - detections.data());
      return Unexpected(std::move(error));
    }
    joined.push_back(std::move(*one));
  }
  return joined;
}

}  // namespace hypermap

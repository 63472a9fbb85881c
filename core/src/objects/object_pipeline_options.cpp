// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_pipeline_options.hpp"

#include <utility>

namespace hypermap {
namespace {

Result<void> within(std::string_view stage, Result<void> result) {
  if (result) return result;
  Error error = std::move(result).error();
  error.field = std::string(stage) + "." + error.field;
  return Unexpected(std::move(error));
}

/// [smap] tables D.1 and D.2; what the text leaves open is said beside it.
ObjectPipelineOptions smap_preset() {
  ObjectPipelineOptions o;
  o.segmentation = smap_segmentation();
  o.association.policy = AssociationPolicy::kSmap;
  o.association.position_error_m = 0.2;  // o_e
  o.association.tracking_factor = 0.5;   // o_t
  o.association.box_from_points = false;
  o.association.belief = {.saturation = Saturation::kClamp};
  o.binned_depth.columns = 24;
  o.binned_depth.rows = 16;
  o.binned_depth.max_range_m = o.segmentation.max_range_m;
  o.absence.policy = VisibilityPolicy::kPanels;
  o.absence.missed_decay = LogOdds{0.0};   // an object whose panels lie inside it is valid
  o.absence.absent_decay = LogOdds{0.0};   // existence is not in this source
  o.absence.partly_occluded_factor = 0.5;  // "attenuated"
  o.absence.occluded_factor = 0.1;         // "a small decay"
  o.absence.spare_seen = false;
  o.absence.expected_range_factor = 0.0;
  o.absence.removal = RemovalRule::kConfidence;
  o.absence.min_confidence = Probability(0.5);  // o_valid
  o.absence.confidence.rule = ConfidenceRule::kWeighted;
  o.publication.min_existence = std::nullopt;
  o.publication.min_confidence = Probability(0.5);  // o_valid
  o.publication.confidence.rule = ConfidenceRule::kWeighted;
  o.publication.min_observations = 1;
  o.publication.one_per_place = false;
  o.footprint = ShapePolicy::kHull;
  return o;
}

/// [hypermap] 3.4.4, 3.4.5 and 5.2.2; cap and removal are those of its public implementation.
ObjectPipelineOptions hypermap_preset() {
  ObjectPipelineOptions o;
  o.segmentation = hypermap_segmentation();
  o.association.policy = AssociationPolicy::kOverlap;
  o.association.min_jaccard = 0.2;
  o.association.shape = ShapePolicy::kBest;
  o.association.belief = {.saturation = Saturation::kClamp};
  o.association.points.min_vote_share = 0.0;  // the box is that of all evidence
  o.absence.policy = VisibilityPolicy::kHull;
  o.absence.missed_decay = LogOdds{0.2};
  o.absence.absent_class_decay = LogOdds{0.0};
  o.absence.spare_seen = false;
  o.absence.expected_range_factor = 0.0;
  o.absence.min_existence = LogOdds{-5.0};
  o.publication.min_existence = LogOdds{2.0};
  o.publication.min_observations = 1;
  o.publication.one_per_place = false;
  o.footprint = ShapePolicy::kBest;
  return o;
}

}  // namespace

Result<void> validate(const ObjectPipelineOptions& options) {
  HYPERMAP_TRY(within("stacking", validate(options.stacking)));
  HYPERMAP_TRY(within("segmentation", validate(options.segmentation)));
  HYPERMAP_TRY(within("association", validate(options.association)));
  HYPERMAP_TRY(within("binned_depth", validate(options.binned_depth)));
  HYPERMAP_TRY(within("absence", validate(options.absence)));
  return within("publication", validate(options.publication));
}

ObjectPipelineOptions preset(PresetName name) {
  switch (name) {
    case PresetName::kSmap:
      return smap_preset();
    case PresetName::kHypermap:
      return hypermap_preset();
    case PresetName::kDefault:
      break;
  }
  return {};
}

std::optional<PresetName> preset_of(std::string_view name) {
  for (const PresetName preset : {PresetName::kDefault, PresetName::kSmap, PresetName::kHypermap}) {
    if (to_string(preset) == name) return preset;
  }
  return std::nullopt;
}

std::string_view to_string(PresetName name) {
  switch (name) {
    case PresetName::kSmap:
      return "smap";
    case PresetName::kHypermap:
      return "hypermap";
    case PresetName::kDefault:
      break;
  }
  return "default";
}

}  // namespace hypermap

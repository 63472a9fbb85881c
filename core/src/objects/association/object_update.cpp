// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/segmentation/projected_shape.hpp"
#include "policies.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace hypermap {
namespace {

/// The observation's classes as the belief takes them. By views it takes what was detected alone,
/// and class_distribution applies what is known besides: a belief says, too, which observations are
/// of one object, of which outside knowledge says nothing.
///
/// Source: [smap] Eq. (3.17).
std::vector<ClassEvidence> believed_scores(const Observation& observation,
                                           ClassTempering tempering) {
  if (tempering == ClassTempering::kViews) return observation.class_scores;
  return with_prior(observation.class_scores, observation.prior);
}

/// Source: [smap] Eq. (3.18); N is the number of classes of the combined set, of which a vector may
/// name a part.
void update_belief(Object& object, const Observation& observation) {
  const std::size_t num_classes =
      std::max({std::size_t{2}, observation.class_scores.size(), observation.num_classes});
  object.belief.observe(believed_scores(observation, object.belief.options().tempering),
                        Probability(1.0 / static_cast<double>(num_classes)));
}

/// Source: [smap] Eq. (3.20), (3.21): the more confident the track, the less one observation moves
/// it.
void filter_box(Object& object, const Segment& segment, const AssociationOptions& options) {
  const double most = options.max_box_confidence;
  const Probability confidence(std::clamp(segment.box_confidence.value(), 1.0 - most, most));
  object.box_confidence = std::clamp(object.box_confidence + LogOdds::of(confidence),
                                     LogOdds{} - options.max_box_log_odds,
                                     options.max_box_log_odds);
  const double from_confidence = 1.0 / (1.0 + std::exp(object.box_confidence.value()));
  const double gain =
      object.num_observations == 0 ? 1.0 : std::max(options.min_gain, from_confidence);
  const auto blend = [gain](Eigen::Vector3d& old, const Eigen::Vector3d& seen) {
    old = (1.0 - gain) * old + gain * seen;
  };
  blend(object.box.min_in_map, segment.box.min_in_map);
  blend(object.box.max_in_map, segment.box.max_in_map);
  blend(object.centroid_in_map, segment.centroid_in_map);
}

void update_geometry(Object& object, const Segment& segment, const AssociationOptions& options) {
  filter_box(object, segment, options);
  object.points.observe(segment.points_in_map);
  if (auto shape = projected_hull(segment.points_in_map, options.shape_leaf_m)) {
    object.shapes.add(*shape);
  }
  if (!options.box_from_points) return;
  if (const auto box = object.points.agreed_box()) {
    object.box = *box;
    object.centroid_in_map = box->centre();
  }
}

/// Of an object by one observation.
struct Effect {
  LogOdds existence;
  LogOdds named_class;
  BeliefChanges other_classes;
};

void record(Object& object, const Observation& observation, const Effect& effect) {
  object.observation_log.add({.frame_index = observation.frame_index,
                              .stamp = observation.stamp,
                              .kind = ObservationKind::kDetection,
                              .visibility = Visibility::kVisible,
                              .detector = observation.detector,
                              .class_id = named_class(observation),
                              .score = static_cast<float>(observation.score.value()),
                              .bearing_rad = static_cast<float>(observation.bearing_rad),
                              .distance_m = static_cast<float>(observation.distance_m),
                              .effect = static_cast<float>(effect.existence.value()),
                              .belief_change = static_cast<float>(effect.named_class.value()),
                              .other_changes = effect.other_classes});
}

}  // namespace

void update_object(Object& object,
                   const Observation& observation,
                   const AssociationOptions& options) {
  const ClassId named = named_class(observation);
  const ClassBelief before = object.belief;
  update_belief(object, observation);
  object.prior = observation.prior;
  object.histogram.observe(observation.bearing_rad, observation.distance_m);
  update_geometry(object, observation.segment, options);
  object.embeddings.observe(observation.embeddings);
  const LogOdds existed = object.existence;
  object.existence = std::min(object.existence + options.seen_existence, options.max_existence);
  record(
      object,
      observation,
      {.existence = object.existence - existed,
       .named_class = object.belief.log_odds(named) - before.log_odds(named),
       .other_classes = BeliefChanges::between(before.entries(), object.belief.entries(), named)});
  object.last_seen = std::max(object.last_seen, observation.stamp);
  object.farthest_detection_m = std::max(object.farthest_detection_m, observation.distance_m);
  ++object.num_observations;
}

Object make_object(const Observation& observation, const AssociationOptions& options) {
  Object object;
  if (auto belief = ClassBelief::create(options.belief)) object.belief = *std::move(belief);
  object.histogram = VisibilityHistogram(options.histogram);
  object.points = OccupancyVotes(options.points);
  // `update_object` adds `seen_existence`, so that a new object ends with `new_existence`.
  object.existence = options.new_existence - options.seen_existence;
  object.first_seen = observation.stamp;
  object.last_seen = observation.stamp;
  update_object(object, observation, options);
  return object;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/absence.hpp"

#include <algorithm>

namespace hypermap {
namespace {

/// Decay of an object by one visibility result.
struct Decay {
  LogOdds existence;
  double absence = 0.0;  ///< Of the decay that a plain absence means for classes and histogram.
};

/// The detector is expected to see it from where it, or another one, saw it before.
bool is_expected(const Object& object, const VisibilityResult& result, double range_factor) {
  return range_factor == 0.0 || result.distance_m <= range_factor * object.farthest_detection_m;
}

/// C.2 and step 8 of [smap] figure 3.23; the existence is that of [hypermap] 3.4.5.
Decay full_decay_for(const Object& object,
                     const VisibilityResult& result,
                     const AbsenceOptions& options) {
  const bool expected = is_expected(object, result, options.expected_range_factor);
  const LogOdds missed = expected ? options.missed_decay : LogOdds{};
  switch (result.state) {
    case Visibility::kOutOfView:
      return {};
    case Visibility::kVisible:
      return {missed, 0.0};
    case Visibility::kPartlyOccluded:
      return {result.visible_fraction * missed, options.partly_occluded_factor};
    case Visibility::kOccluded:
      return {LogOdds{}, options.occluded_factor};
    case Visibility::kAbsent:
      return {options.absent_decay, 1.0};
  }
  return {};
}

/// Less from a side on which it was never detected. Source: [smap] 3.5.2, figure 3.18.
Decay decay_for(const Object& object,
                const VisibilityResult& result,
                const AbsenceOptions& options) {
  const Decay full = full_decay_for(object, result, options);
  if (was_detected_from(object.observation_log, result.bearing_rad)) return full;
  const double share = options.unseen_side_factor;
  return {share * full.existence, share * full.absence};
}

void count(AbsenceReport& report, Visibility state) {
  switch (state) {
    case Visibility::kOutOfView:
      ++report.num_out_of_view;
      return;
    case Visibility::kVisible:
      ++report.num_visible;
      return;
    case Visibility::kPartlyOccluded:
      ++report.num_partly_occluded;
      return;
    case Visibility::kOccluded:
      ++report.num_occluded;
      return;
    case Visibility::kAbsent:
      ++report.num_absent;
      return;
  }
}

void weaken(Object& object,
            const VisibilityResult& result,
            const Decay& decay,
            const AbsenceOptions& options) {
  object.existence -= decay.existence;
  object.belief.weaken(decay.absence * options.absent_class_decay);
  object.histogram.weaken(result.bearing_rad, result.distance_m, decay.absence);
}

/// Of an object's belief, by one observation.
struct ChangedClasses {
  ClassId class_id;  ///< That the entry of the log is of.
  LogOdds of_class;
  BeliefChanges of_others;
};

void record(Object& object,
            const VisibilityResult& result,
            const Decay& decay,
            const ChangedClasses& change,
            std::uint64_t frame_index,
            Stamp stamp) {
  object.observation_log.add({.frame_index = frame_index,
                              .stamp = stamp,
                              .kind = ObservationKind::kMissedDetection,
                              .visibility = result.state,
                              .detector = DetectorId{},
                              .class_id = change.class_id,
                              .score = static_cast<float>(result.visible_fraction),
                              .bearing_rad = static_cast<float>(result.bearing_rad),
                              .distance_m = static_cast<float>(result.distance_m),
                              .effect = static_cast<float>(-decay.existence.value()),
                              .belief_change = static_cast<float>(change.of_class.value()),
                              .other_changes = change.of_others});
}

/// The newest entry if that is a detection in the frame, else null.
const ObservationLogEntry* newest_detection_in(const ObservationLog& log,
                                               std::uint64_t frame_index,
                                               Stamp stamp) {
  const auto& newest = log.state().newest;
  const bool is_one = !newest.empty() && newest.back().kind == ObservationKind::kDetection &&
                      newest.back().frame_index == frame_index && newest.back().stamp == stamp;
  return is_one ? &newest.back() : nullptr;
}

/// The class that an entry of the log tells the change of: for a missed detection the object's own.
ClassId class_of_entry(const Object& object, const ObservationLogEntry* detection) {
  if (detection != nullptr) return detection->class_id;
  const auto best = object.belief.best();
  return best ? best->id : ClassId{};
}

/// Step 8. A frame in which the object was detected is no missed detection, whatever its place
/// looks like: what it takes is told with the detection.
void decay_object(Object& object,
                  const VisibilityResult& result,
                  const Decay& decay,
                  const AbsenceOptions& options,
                  std::uint64_t frame_index,
                  Stamp stamp) {
  const ObservationLogEntry* detection =
      newest_detection_in(object.observation_log, frame_index, stamp);
  const ClassId class_id = class_of_entry(object, detection);
  const ClassBelief before = object.belief;
  weaken(object, result, decay, options);
  const ChangedClasses change{
      .class_id = class_id,
      .of_class = object.belief.log_odds(class_id) - before.log_odds(class_id),
      .of_others = BeliefChanges::between(before.entries(), object.belief.entries(), class_id)};
  if (detection != nullptr) {
    object.observation_log.add_to_newest(
        LogOdds{} - decay.existence, change.of_class, change.of_others);
  } else {
    record(object, result, decay, change, frame_index, stamp);
  }
}

/// Whether the object shows again, or its place is at least not seen through, after clear looks
/// through it: an entry of the log, though nothing decays by it.
bool ends_absence(const Object& object, const VisibilityResult& result) {
  const bool is_there =
      result.state == Visibility::kVisible ||
      (result.state == Visibility::kPartlyOccluded && result.visible_fraction > 0);
  return is_there && absence_run(object.observation_log).looks > 0;
}

/// C.3 of [smap] figure 3.23.
bool is_to_be_removed(const Object& object, const AbsenceOptions& options) {
  return options.removal == RemovalRule::kExistence
             ? object.existence < options.min_existence
             : object_confidence(object, options.confidence) < options.min_confidence;
}

}  // namespace

AbsenceReport apply_absences(ObjectMap& objects,
                             std::span<const VisibilityResult> results,
                             const AbsenceOptions& options,
                             std::span<const ObjectId> detected,
                             std::uint64_t frame_index,
                             Stamp stamp) {
  AbsenceReport report;
  for (const VisibilityResult& result : results) {  // one per object in view: C.1, C.2
    const Object* object = objects.find(result.object);
    if (object == nullptr) continue;
    count(report, result.state);
    const bool is_detected = std::binary_search(detected.begin(), detected.end(), result.object);
    if (is_detected && options.spare_seen) continue;
    const Decay decay = decay_for(*object, result, options);
    const bool has_effect = decay.existence != LogOdds{} || decay.absence != 0.0;
    if (!has_effect && !ends_absence(*object, result)) continue;
    objects.modify(result.object, [&](Object& weakened) {  // step 8
      decay_object(weakened, result, decay, options, frame_index, stamp);
    });
    if (is_to_be_removed(objects.at(result.object), options)) {  // C.3
      report.removed.push_back(result.object);
    }
  }
  for (const ObjectId id : report.removed) objects.erase(id);
  std::sort(report.removed.begin(), report.removed.end());
  return report;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/absence.hpp"

#include <algorithm>

namespace hypermap {
namespace {

/// What a verdict takes from an object.
struct Decay {
  LogOdds existence;
  double absence = 0.0;  ///< Of the decay that a plain absence means for classes and histogram.
};

/// The detector is expected to see it from where it, or another one, saw it before.
bool is_expected(const Object& object, const VisibilityVerdict& verdict, double range_factor) {
  return range_factor == 0.0 || verdict.distance_m <= range_factor * object.farthest_detection_m;
}

/// C.2 and step 8 of [smap] figure 3.23; the existence is that of [hypermap] 3.4.5.
Decay decay_for(const Object& object,
                const VisibilityVerdict& verdict,
                const AbsenceOptions& options) {
  const bool expected = is_expected(object, verdict, options.expected_range_factor);
  const LogOdds missed = expected ? options.missed_decay : LogOdds{};
  switch (verdict.state) {
    case Visibility::kOutOfView:
      return {};
    case Visibility::kVisible:
      return {missed, 0.0};
    case Visibility::kPartlyOccluded:
      return {verdict.visible_fraction * missed, options.partly_occluded_factor};
    case Visibility::kOccluded:
      return {LogOdds{}, options.occluded_factor};
    case Visibility::kAbsent:
      return {options.absent_decay, 1.0};
  }
  return {};
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
            const VisibilityVerdict& verdict,
            const Decay& decay,
            const AbsenceOptions& options) {
  object.existence -= decay.existence;
  object.belief.weaken(decay.absence * options.absent_class_decay);
  object.histogram.weaken(verdict.bearing_rad, verdict.distance_m, decay.absence);
}

void record(Object& object,
            const VisibilityVerdict& verdict,
            const Decay& decay,
            std::uint64_t frame_index,
            Stamp stamp) {
  const auto best = object.belief.best();
  object.ledger.add({.frame_index = frame_index,
                     .stamp = stamp,
                     .kind = LedgerKind::kVerdict,
                     .visibility = verdict.state,
                     .detector = DetectorId{},
                     .class_id = best ? best->id : ClassId{},
                     .score = static_cast<float>(verdict.visible_fraction),
                     .bearing_rad = static_cast<float>(verdict.bearing_rad),
                     .distance_m = static_cast<float>(verdict.distance_m),
                     .effect = static_cast<float>(-decay.existence.value())});
}

/// C.3 of [smap] figure 3.23.
bool is_to_be_removed(const Object& object, const AbsenceOptions& options) {
  return options.removal == RemovalRule::kExistence
             ? object.existence < options.min_existence
             : object_confidence(object, options.confidence) < options.min_confidence;
}

}  // namespace

AbsenceReport apply_absences(ObjectMap& objects,
                             std::span<const VisibilityVerdict> verdicts,
                             const AbsenceOptions& options,
                             std::span<const ObjectId> seen_now,
                             std::uint64_t frame_index,
                             Stamp stamp) {
  AbsenceReport report;
  for (const VisibilityVerdict& verdict : verdicts) {  // one per object in view: C.1, C.2
    const Object* object = objects.find(verdict.object);
    if (object == nullptr) continue;
    count(report, verdict.state);
    const bool is_seen = std::binary_search(seen_now.begin(), seen_now.end(), verdict.object);
    if (is_seen && options.spare_seen) continue;
    const Decay decay = decay_for(*object, verdict, options);
    if (decay.existence == LogOdds{} && decay.absence == 0.0) continue;
    objects.modify(verdict.object, [&](Object& weakened) {  // step 8
      weaken(weakened, verdict, decay, options);
      record(weakened, verdict, decay, frame_index, stamp);
    });
    if (is_to_be_removed(objects.at(verdict.object), options)) {  // C.3
      report.removed.push_back(verdict.object);
    }
  }
  for (const ObjectId id : report.removed) objects.erase(id);
  std::sort(report.removed.begin(), report.removed.end());
  return report;
}

}  // namespace hypermap

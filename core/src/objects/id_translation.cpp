// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/id_translation.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

template <class Id>
Result<Id> translated_id(Id id, std::span<const Id> ids, std::string_view field) {
  if (id.value < ids.size()) return ids[id.value];
  return fail(ErrorCode::kInvalidArgument,
              "is " + std::to_string(id.value) + " of " + std::to_string(ids.size()),
              std::string(field));
}

Result<std::uint64_t> later_index(std::uint64_t index, std::uint64_t offset) {
  if (index <= std::numeric_limits<std::uint64_t>::max() - offset) return index + offset;
  return fail(ErrorCode::kInvalidArgument, "grows beyond 2^64 - 1", "frame_index");
}

/// In ascending order of the new ids.
Result<std::vector<ClassLogOdds>> translated_classes(std::span<const ClassLogOdds> classes,
                                                     const IdTranslation& translation) {
  std::vector<ClassLogOdds> out(classes.begin(), classes.end());
  for (ClassLogOdds& one : out) {
    HYPERMAP_ASSIGN_OR_RETURN(one.id, translated_id<ClassId>(one.id, translation.classes, "class"));
  }
  std::ranges::sort(out, {}, &ClassLogOdds::id);
  return out;
}

/// Of a missed detection the detector is nobody, and stays so.
template <class Entry>
Result<void> translate_detection(Entry& entry, const IdTranslation& translation) {
  HYPERMAP_ASSIGN_OR_RETURN(entry.class_id,
                            translated_id<ClassId>(entry.class_id, translation.classes, "class"));
  if (entry.kind == ObservationKind::kMissedDetection) return {};
  HYPERMAP_ASSIGN_OR_RETURN(
      entry.detector, translated_id<DetectorId>(entry.detector, translation.detectors, "detector"));
  return {};
}

Result<BeliefChanges> translated_changes(const BeliefChanges& changes,
                                         const IdTranslation& translation) {
  std::vector<BeliefChange> out(changes.entries().begin(), changes.entries().end());
  for (BeliefChange& change : out) {
    HYPERMAP_ASSIGN_OR_RETURN(
        change.class_id, translated_id<ClassId>(change.class_id, translation.classes, "class"));
  }
  return BeliefChanges::from_entries(out);
}

Result<void> translate(ObservationLogEntry& entry, const IdTranslation& translation) {
  HYPERMAP_ASSIGN_OR_RETURN(entry.frame_index,
                            later_index(entry.frame_index, translation.frame_offset));
  HYPERMAP_ASSIGN_OR_RETURN(entry.other_changes,
                            translated_changes(entry.other_changes, translation));
  return translate_detection(entry, translation);
}

Result<ObservationLog> translated_log(const ObservationLog& log, const IdTranslation& translation) {
  ObservationLogState state = log.state();
  if (state.first) HYPERMAP_TRY(translate(*state.first, translation));
  for (ObservationLogEntry& entry : state.newest) HYPERMAP_TRY(translate(entry, translation));
  for (ObservationLogSummary& summary : state.summaries) {
    HYPERMAP_ASSIGN_OR_RETURN(summary.last_frame_index,
                              later_index(summary.last_frame_index, translation.frame_offset));
    HYPERMAP_TRY(translate_detection(summary, translation));
  }
  std::ranges::sort(state.summaries, {}, [](const ObservationLogSummary& s) {
    return std::tuple(s.kind, s.detector, s.class_id, s.bearing_bin);
  });
  return ObservationLog::from_state(std::move(state));
}

Result<Object> translated_object(Object object, const IdTranslation& translation) {
  HYPERMAP_ASSIGN_OR_RETURN(auto belief, translated_classes(object.belief.entries(), translation));
  HYPERMAP_ASSIGN_OR_RETURN(object.belief,
                            ClassBelief::from_entries(object.belief.options(), std::move(belief)));
  HYPERMAP_ASSIGN_OR_RETURN(auto prior,
                            translated_classes(object.prior.log_factors(), translation));
  HYPERMAP_ASSIGN_OR_RETURN(object.prior, ClassPrior::create(std::move(prior)));
  HYPERMAP_ASSIGN_OR_RETURN(object.observation_log,
                            translated_log(object.observation_log, translation));
  return object;
}

}  // namespace

Result<ObjectMap> translated(const ObjectMap& objects, const IdTranslation& translation) {
  std::vector<Object> out;
  out.reserve(objects.size());
  for (const Object& object : objects.objects()) {
    auto there = translated_object(object, translation);
    if (!there) {
      Error error = there.error();
      error.entry = "object " + std::to_string(object.id.value);
      return Unexpected(std::move(error));
    }
    out.push_back(std::move(*there));
  }
  return ObjectMap::restore(std::move(out), objects.next_id());
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/object_history.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using Entries = std::vector<ObservationLogEntry>;

bool is_detection(const ObservationLogEntry& entry) {
  return entry.kind == ObservationKind::kDetection;
}

/// The entries that are kept one by one, oldest first, each once.
Entries kept_entries(const ObservationLogState& log) {
  Entries kept = log.newest;
  const bool has_first = !log.first || std::ranges::find(kept, *log.first) != kept.end();
  if (!has_first) kept.insert(kept.begin(), *log.first);
  return kept;
}

std::uint64_t num_entries(const ObservationLogState& log) {
  std::uint64_t count = log.num_unsummarised;
  for (const ObservationLogSummary& summary : log.summaries) count += summary.count;
  return count;
}

/// Whether every entry that ever came is one of `kept`.
bool is_every_entry(const Entries& kept, const ObservationLogState& log) {
  return num_entries(log) <= kept.size();
}

bool is_of(const ObservationLogSummary& summary, const ObservationLogEntry& entry) {
  const auto bin = log_bearing_bin(static_cast<double>(entry.bearing_rad));
  return std::tuple(summary.kind, summary.detector, summary.class_id, summary.bearing_bin) ==
         std::tuple(entry.kind, entry.detector, entry.class_id, bin);
}

/// Takes one entry out of the sums again. False when no sum has it.
bool take_back(std::vector<ObservationLogSummary>& summaries, const ObservationLogEntry& entry) {
  const auto sum = std::ranges::find_if(
      summaries, [&](const ObservationLogSummary& summary) { return is_of(summary, entry); });
  if (sum == summaries.end()) return false;
  --sum->count;
  sum->score_sum = std::max(0.0F, sum->score_sum - entry.score);
  sum->effect_sum -= entry.effect;
  if (sum->count == 0) summaries.erase(sum);
  return true;
}

PastLog first_alone(const ObservationLogEntry& first) {
  PastLog past{.log = {}, .is_whole = false};
  past.log.add(first);
  return past;
}

/// How many of the entries had come. None when they are not those before all others.
std::optional<std::size_t> num_come(const Entries& entries, const MapMoment& moment) {
  const auto has_come = [&](const ObservationLogEntry& entry) { return moment.has_come(entry); };
  const auto end = std::ranges::find_if_not(entries, has_come);
  if (std::any_of(end, entries.end(), has_come)) return std::nullopt;
  return static_cast<std::size_t>(end - entries.begin());
}

/// The newest looks, all of them through the object's place, may go on in entries that are lost.
bool may_go_on(const ObservationLog& log) {
  const auto& kept = log.state().newest;
  return kept.size() < ObservationLog::kMaxNewest && absence_run(log).looks == kept.size();
}

/// The sums of now without those of the newest entries from the `num_kept`-th on.
/// Requires: 0 < num_kept, and not every entry of the log is kept.
PastLog without_newer(const ObservationLogState& now, std::size_t num_kept) {
  ObservationLogState then = now;
  then.newest.resize(num_kept);
  bool is_whole = now.num_unsummarised == 0;
  for (std::size_t i = num_kept; i < now.newest.size(); ++i) {
    is_whole = take_back(then.summaries, now.newest[i]) && is_whole;
  }
  for (ObservationLogSummary& summary : then.summaries) {
    summary.last_frame_index = std::min(summary.last_frame_index, then.newest.back().frame_index);
  }
  auto log = ObservationLog::from_state(std::move(then));
  if (!is_whole || !log || may_go_on(*log)) return first_alone(*now.first);
  return {.log = std::move(*log)};
}

std::set<ClassId> named_classes_of(const ObservationLog& log) {
  std::set<ClassId> named;
  for (const ObservationLogSummary& summary : log.state().summaries) {
    if (summary.kind == ObservationKind::kDetection) named.insert(summary.class_id);
  }
  return named;
}

/// The belief without the classes that detections named after the moment alone.
ClassBelief without_newly_named(const ClassBelief& belief,
                                const ObservationLog& now,
                                const ObservationLog& then) {
  const auto named_now = named_classes_of(now);
  const auto named_then = named_classes_of(then);
  std::vector<ClassLogOdds> entries(belief.entries().begin(), belief.entries().end());
  std::erase_if(entries, [&](const ClassLogOdds& entry) {
    return named_now.contains(entry.id) && !named_then.contains(entry.id);
  });
  auto known = ClassBelief::from_entries(belief.options(), std::move(entries));
  if (!known) return belief;
  return std::move(*known);
}

/// What the entries after a moment gave to the existence. Unit: log-odds.
LogOdds newer_effect(const ObservationLogState& now, const MapMoment& moment) {
  double sum = 0.0;
  for (const ObservationLogEntry& entry : kept_entries(now)) {
    if (!moment.has_come(entry)) sum += static_cast<double>(entry.effect);
  }
  return LogOdds(sum);
}

/// Requires: `log` is that of the object at the moment, whole.
Object object_with(Object object, ObservationLog log, const MapMoment& moment) {
  const ObservationLog& now = object.observation_log;
  const std::uint64_t num_newer = now.num_detections() - log.num_detections();
  object.existence -= newer_effect(now.state(), moment);
  object.num_observations -=
      static_cast<std::uint32_t>(std::min<std::uint64_t>(object.num_observations, num_newer));
  object.belief = without_newly_named(object.belief, now, log);
  object.last_seen = last_detection(log).value_or(object.first_seen);
  object.observation_log = std::move(log);
  return object;
}

/// The frame of the newest detection, by the sums.
std::uint64_t last_detection_frame(const ObservationLogState& log) {
  std::uint64_t last = 0;
  for (const ObservationLogSummary& summary : log.summaries) {
    if (summary.kind == ObservationKind::kDetection)
      last = std::max(last, summary.last_frame_index);
  }
  return last;
}

/// Whether detections that are no longer kept may lie in the span.
bool may_hold_lost(const ObservationLogState& log, const ObservationSpan& span) {
  if (!log.first || log.newest.empty()) return true;
  const ObservationLogEntry& first = *log.first;
  const ObservationLogEntry& oldest = log.newest.front();
  if (oldest.frame_index < span.frames.first || span.frames.end <= first.frame_index) return false;
  const bool ends_before =
      log.num_unsummarised == 0 && last_detection_frame(log) < span.frames.first;
  if (ends_before) return false;
  // What lies in the frames of the span bounds what is lost by its stamp, too.
  if (span.frames.contains(oldest.frame_index) && span.since && *span.since > oldest.stamp)
    return false;
  return !(span.frames.contains(first.frame_index) && span.until && *span.until < first.stamp);
}

}  // namespace

Sighting was_seen_in(const Object& object, const ObservationSpan& span) {
  if (span.since && object.last_seen < *span.since) return Sighting::kNotSeen;
  if (span.until && *span.until < object.first_seen) return Sighting::kNotSeen;
  const ObservationLogState& log = object.observation_log.state();
  const auto is_in_stamps = [&](Stamp stamp) {
    return span.contains(span.frames.first, stamp);  // whatever the frame
  };
  const bool ends_count = span.frames == FrameRange{};
  if (ends_count && (is_in_stamps(object.first_seen) || is_in_stamps(object.last_seen)))
    return Sighting::kSeen;
  std::uint64_t num_kept = 0;
  for (const ObservationLogEntry& entry : kept_entries(log)) {
    if (!is_detection(entry)) continue;
    if (span.contains(entry.frame_index, entry.stamp)) return Sighting::kSeen;
    ++num_kept;
  }
  const bool is_any_lost = num_kept < object.num_observations;
  return is_any_lost && may_hold_lost(log, span) ? Sighting::kUnknown : Sighting::kNotSeen;
}

std::optional<Stamp> last_detection(const ObservationLog& log) {
  const Entries kept = kept_entries(log.state());
  const auto last = std::find_if(kept.rbegin(), kept.rend(), is_detection);
  if (last == kept.rend()) return std::nullopt;
  // The first entry is the newest detection only if it is the only one.
  const bool is_first = last + 1 == kept.rend() && log.num_detections() > 1;
  return is_first ? std::nullopt : std::optional(last->stamp);
}

std::optional<Stamp> kept_since(const ObservationLog& log) {
  const ObservationLogState& state = log.state();
  if (!state.first) return std::nullopt;
  if (is_every_entry(kept_entries(state), state) || state.newest.empty()) return state.first->stamp;
  return state.newest.front().stamp;
}

std::optional<PastLog> log_as_of(const ObservationLog& log, const MapMoment& moment) {
  const ObservationLogState& now = log.state();
  if (!now.first || !moment.has_come(*now.first)) return std::nullopt;
  const Entries kept = kept_entries(now);
  const auto num = num_come(kept, moment);
  if (!num) return first_alone(*now.first);
  if (*num == kept.size()) return PastLog{.log = log};
  if (is_every_entry(kept, now)) {
    PastLog past;
    for (std::size_t i = 0; i < *num; ++i) past.log.add(kept[i]);
    return past;
  }
  const std::size_t num_newest = *num_come(now.newest, moment);
  return num_newest == 0 ? first_alone(*now.first) : without_newer(now, num_newest);
}

PastObjects objects_as_of(const ObjectMap& objects, const MapMoment& moment) {
  PastObjects past{.objects = objects, .unknown = objects};
  for (const Object& object : objects.objects()) {
    const bool has_log = object.observation_log.state().first.has_value();
    auto log = log_as_of(object.observation_log, moment);
    const bool is_later = has_log ? !log : object.first_seen > moment.stamp;
    if (log && log->is_whole) {
      past.objects.replace(object_with(object, std::move(log->log), moment));
      past.unknown.erase(object.id);
    } else {
      past.objects.erase(object.id);
      if (is_later) past.unknown.erase(object.id);
    }
  }
  return past;
}

}  // namespace hypermap

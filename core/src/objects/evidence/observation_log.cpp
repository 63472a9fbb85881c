// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/observation_log.hpp"

#include "objects/evidence/gone_run.hpp"
#include "objects/evidence/in_thousandths.hpp"
#include "objects/evidence/log_frames.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

auto key_of(const ObservationLogSummary& s) {
  return std::tuple(s.kind, s.detector, s.class_id, s.bearing_bin);
}

bool precedes(const ObservationLogSummary& a, const ObservationLogSummary& b) {
  return key_of(a) < key_of(b);
}

bool is_finite(const ObservationLogEntry& e) {
  return std::isfinite(e.score) && std::isfinite(e.bearing_rad) && std::isfinite(e.distance_m) &&
         std::isfinite(e.effect) && std::isfinite(e.belief_change);
}

bool tells_its_class_twice(const ObservationLogEntry& e) {
  return e.other_changes.contains(e.class_id);
}

bool is_sound(const ObservationLogSummary& s) {
  return s.bearing_bin < ObservationLog::kNumBearingBins && s.count > 0 &&
         std::isfinite(s.score_sum) && std::isfinite(s.effect_sum);
}

ObservationLogSummary summary_of(const ObservationLogEntry& e) {
  return {.kind = e.kind,
          .detector = e.detector,
          .class_id = e.class_id,
          .bearing_bin = log_bearing_bin(static_cast<double>(e.bearing_rad)),
          .count = 1,
          .score_sum = e.score,
          .effect_sum = e.effect,
          .last_frame_index = e.frame_index};
}

bool is_older(const ObservationLogEntry& a, const ObservationLogEntry& b) {
  return a.frame_index < b.frame_index;
}

/// Moves what was missed in a frame with a detection to the end. Returns where that begins.
auto part_contradicted(std::vector<ObservationLogEntry>& entries) {
  const auto detected = detected_frames(entries);
  return std::stable_partition(
      entries.begin(), entries.end(), [&](const ObservationLogEntry& entry) {
        return entry.kind == ObservationKind::kDetection ||
               !std::ranges::binary_search(detected, frame_of(entry));
      });
}

void keep_newest(std::vector<ObservationLogEntry>& entries) {
  if (entries.size() <= ObservationLog::kMaxNewest) return;
  entries.erase(entries.begin(),
                entries.end() - static_cast<std::ptrdiff_t>(ObservationLog::kMaxNewest));
}

}  // namespace

Result<ObservationLog> ObservationLog::from_state(ObservationLogState state) {
  const auto refuse = [](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, what, "ledger");
  };
  if (state.newest.size() > kMaxNewest || state.summaries.size() > kMaxSummaries) {
    return refuse("must have at most 64 newest entries and 256 summaries, has " +
                  std::to_string(state.newest.size()) + " and " +
                  std::to_string(state.summaries.size()));
  }
  if (!state.newest.empty() && !state.first) return refuse("has newest entries but no first one");
  const bool finite = (!state.first || is_finite(*state.first)) &&
                      std::all_of(state.newest.begin(), state.newest.end(), is_finite) &&
                      std::all_of(state.summaries.begin(), state.summaries.end(), is_sound);
  if (!finite) return refuse("has a number that is not finite, a count of 0 or a bin beyond 17");
  const bool is_told_twice = (state.first && tells_its_class_twice(*state.first)) ||
                             std::ranges::any_of(state.newest, tells_its_class_twice);
  if (is_told_twice) return refuse("has an entry whose other changes are of its own class");
  const auto not_ascending = [](const ObservationLogSummary& a, const ObservationLogSummary& b) {
    return !precedes(a, b);
  };
  if (std::adjacent_find(state.summaries.begin(), state.summaries.end(), not_ascending) !=
      state.summaries.end()) {
    return refuse("summaries must ascend by kind, detector, class and bearing bin");
  }
  ObservationLog observation_log;
  observation_log.state_ = std::move(state);
  return observation_log;
}

void ObservationLog::add(const ObservationLogEntry& entry) {
  ObservationLogEntry kept = entry;
  kept.belief_change = in_thousandths(static_cast<double>(entry.belief_change));
  if (!state_.first) state_.first = kept;
  state_.newest.push_back(kept);
  keep_newest(state_.newest);
  summarise(summary_of(kept));
}

void ObservationLog::add_to_newest(LogOdds existence_change,
                                   LogOdds belief_change,
                                   const BeliefChanges& other_changes) {
  ObservationLogEntry& newest = state_.newest.back();
  const bool is_first = state_.first == newest;
  const auto key = key_of(summary_of(newest));
  const auto effect = static_cast<float>(existence_change.value());
  newest.effect += effect;
  newest.belief_change =
      in_thousandths(static_cast<double>(newest.belief_change) + belief_change.value());
  newest.other_changes.add(other_changes);
  if (is_first) state_.first = newest;
  const auto sum = std::ranges::find(state_.summaries, key, &key_of);
  if (sum != state_.summaries.end()) sum->effect_sum += effect;
}

void ObservationLog::merge(const ObservationLog& other) {
  if (!state_.first || (other.state_.first && is_older(*other.state_.first, *state_.first))) {
    state_.first = other.state_.first;
  }
  std::vector<ObservationLogEntry> both = state_.newest;
  both.insert(both.end(), other.state_.newest.begin(), other.state_.newest.end());
  std::stable_sort(both.begin(), both.end(), is_older);
  for (const ObservationLogSummary& summary : other.state_.summaries) summarise(summary);
  state_.num_unsummarised += other.state_.num_unsummarised;
  const auto contradicted = part_contradicted(both);
  std::for_each(contradicted, both.end(), [this](const auto& entry) { take_back(entry); });
  both.erase(contradicted, both.end());
  keep_newest(both);
  state_.newest = std::move(both);
}

void ObservationLog::take_back(const ObservationLogEntry& entry) {
  const ObservationLogSummary taken = summary_of(entry);
  auto& all = state_.summaries;
  const auto it = std::lower_bound(all.begin(), all.end(), taken, precedes);
  if (it == all.end() || key_of(*it) != key_of(taken)) {
    if (state_.num_unsummarised > 0) --state_.num_unsummarised;
    return;
  }
  it->score_sum -= taken.score_sum;
  it->effect_sum -= taken.effect_sum;
  if (--it->count == 0) all.erase(it);
}

void ObservationLog::summarise(const ObservationLogSummary& addition) {
  auto& all = state_.summaries;
  const auto it = std::lower_bound(all.begin(), all.end(), addition, precedes);
  if (it != all.end() && key_of(*it) == key_of(addition)) {
    it->count += addition.count;
    it->score_sum += addition.score_sum;
    it->effect_sum += addition.effect_sum;
    it->last_frame_index = std::max(it->last_frame_index, addition.last_frame_index);
  } else if (all.size() < kMaxSummaries) {
    all.insert(it, addition);
  } else {
    state_.num_unsummarised += addition.count;
  }
}

std::uint64_t ObservationLog::num_detections(std::optional<ClassId> class_id) const {
  std::uint64_t count = 0;
  for (const ObservationLogSummary& s : state_.summaries) {
    const bool counts =
        s.kind == ObservationKind::kDetection && (!class_id || s.class_id == *class_id);
    if (counts) count += s.count;
  }
  return count;
}

namespace {

/// Detections of the classes that each detector named most often.
std::uint64_t num_of_usual_names(const ObservationLog& log) {
  std::map<std::pair<DetectorId, ClassId>, std::uint64_t> counts;
  for (const ObservationLogSummary& s : log.state().summaries) {
    if (s.kind == ObservationKind::kDetection) counts[{s.detector, s.class_id}] += s.count;
  }
  std::map<DetectorId, std::uint64_t> most;
  for (const auto& [name, count] : counts) {
    most[name.first] = std::max(most[name.first], count);
  }
  std::uint64_t sum = 0;
  for (const auto& [detector, count] : most) sum += count;
  return sum;
}

}  // namespace

DetectionRegularity detection_regularity(const ObservationLog& log) {
  DetectionRegularity regularity;
  std::bitset<ObservationLog::kNumBearingBins> directions;
  for (const ObservationLogSummary& s : log.state().summaries) {
    if (s.kind == ObservationKind::kDetection) {
      regularity.num_detections += s.count;
      directions.set(s.bearing_bin);
    } else {
      regularity.missed_visibility += static_cast<double>(s.score_sum);
    }
  }
  // A file may say less than nothing, and sums that entries left are off by their rounding.
  regularity.missed_visibility = std::max(0.0, regularity.missed_visibility);
  regularity.num_directions = static_cast<int>(directions.count());
  regularity.num_named_otherwise = regularity.num_detections - num_of_usual_names(log);
  return regularity;
}

AbsenceRun absence_run(const ObservationLog& log) {
  const auto& newest = log.state().newest;
  const auto begin =
      std::find_if(newest.rbegin(), newest.rend(), [](const ObservationLogEntry& entry) {
        return entry.visibility != Visibility::kAbsent;
      }).base();
  if (begin == newest.end()) return {};
  return {.looks = static_cast<std::uint32_t>(newest.end() - begin),
          .first = begin->stamp,
          .last = newest.back().stamp};
}

bool is_gone_by(const AbsenceRun& run, const GoneRule& rule) {
  if (rule.looks == 0 || run.looks < rule.looks) return false;
  // As doubles: the difference of two stamps from a file may be no int64.
  const double seconds =
      1e-9 * (static_cast<double>(run.last.ns) - static_cast<double>(run.first.ns));
  return run.looks >= ObservationLog::kMaxNewest || seconds >= rule.seconds;
}

GoneRule gone_rule_for(std::uint64_t num_detections, const GoneRule& rule) {
  if (rule.rare_looks == 0 || num_detections == 0) return rule;
  const std::uint64_t outweighed_by =
      1 + (num_detections - 1) / std::max(1U, rule.detections_per_look);
  if (outweighed_by >= rule.looks) return rule;
  GoneRule of_rare = rule;
  of_rare.looks =
      std::min(rule.looks, std::max(static_cast<std::uint32_t>(outweighed_by), rule.rare_looks));
  of_rare.seconds = 0.0;
  return of_rare;
}

bool is_gone(const ObservationLog& log, const GoneRule& rule) {
  return is_gone_by(absence_run(log), gone_rule_for(log.num_detections(), rule));
}

std::uint64_t num_detections_from(const ObservationLog& log, double bearing_rad) {
  const int side = log_bearing_bin(bearing_rad);
  std::uint64_t count = 0;
  for (const ObservationLogSummary& summary : log.state().summaries) {
    const int bins_apart = std::abs(summary.bearing_bin - side);
    const bool is_beside = std::min(bins_apart, ObservationLog::kNumBearingBins - bins_apart) <= 1;
    if (summary.kind == ObservationKind::kDetection && is_beside) count += summary.count;
  }
  return count;
}

bool was_detected_from(const ObservationLog& log, double bearing_rad) {
  return num_detections_from(log, bearing_rad) > 0 || log.num_detections() == 0;
}

std::uint8_t log_bearing_bin(double bearing_rad) {
  const double turns = bearing_rad / (2.0 * std::numbers::pi);
  const double share = turns - std::floor(turns);
  const int bin = static_cast<int>(share * ObservationLog::kNumBearingBins);
  return static_cast<std::uint8_t>(std::min(bin, ObservationLog::kNumBearingBins - 1));
}

}  // namespace hypermap

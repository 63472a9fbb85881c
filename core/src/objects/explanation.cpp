// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/explanation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

std::vector<Naming> namings_of(const ObservationLogState& log) {
  struct Sum {
    Naming naming;
    double score_sum = 0.0;
    std::set<std::uint8_t> bins;
  };
  std::map<std::pair<DetectorId, ClassId>, Sum> sums;
  for (const ObservationLogSummary& summary : log.summaries) {
    if (summary.kind != ObservationKind::kDetection) continue;
    Sum& sum = sums[{summary.detector, summary.class_id}];
    sum.naming.detector = summary.detector;
    sum.naming.class_id = summary.class_id;
    sum.naming.num_detections += summary.count;
    sum.score_sum += static_cast<double>(summary.score_sum);
    sum.bins.insert(summary.bearing_bin);
    sum.naming.last_frame_index = std::max(sum.naming.last_frame_index, summary.last_frame_index);
  }
  std::vector<Naming> namings;
  namings.reserve(sums.size());
  for (auto& [key, sum] : sums) {
    const auto count = static_cast<double>(sum.naming.num_detections);
    sum.naming.mean_score = count > 0.0 ? sum.score_sum / count : 0.0;
    sum.naming.num_directions = static_cast<int>(sum.bins.size());
    namings.push_back(sum.naming);
  }
  std::sort(namings.begin(), namings.end(), [](const Naming& a, const Naming& b) {
    return std::tuple(b.num_detections, a.class_id, a.detector) <
           std::tuple(a.num_detections, b.class_id, b.detector);
  });
  return namings;
}

std::vector<std::uint8_t> directions_of(const ObservationLogState& log) {
  std::set<std::uint8_t> bins;
  for (const ObservationLogSummary& summary : log.summaries) {
    if (summary.kind == ObservationKind::kDetection) bins.insert(summary.bearing_bin);
  }
  return {bins.begin(), bins.end()};
}

MissedDetections missed_detections_of(const ObservationLogState& log) {
  MissedDetections missed;
  double visible = 0.0;
  for (const ObservationLogSummary& summary : log.summaries) {
    if (summary.kind != ObservationKind::kMissedDetection) continue;
    missed.num_frames += summary.count;
    visible += static_cast<double>(summary.score_sum);
    missed.existence_lost -= static_cast<double>(summary.effect_sum);
  }
  if (missed.num_frames > 0)
    missed.mean_visible_share = visible / static_cast<double>(missed.num_frames);
  return missed;
}

/// Of the entries that are kept one by one.
std::optional<ObservationLogEntry> newest_detection(const ObservationLogState& log) {
  for (auto entry = log.newest.rbegin(); entry != log.newest.rend(); ++entry) {
    if (entry->kind == ObservationKind::kDetection) return *entry;
  }
  return std::nullopt;
}

/// Of all that are summed up.
std::optional<std::uint64_t> newest_detection_frame(const ObservationLogState& log) {
  std::optional<std::uint64_t> frame;
  for (const ObservationLogSummary& summary : log.summaries) {
    if (summary.kind != ObservationKind::kDetection) continue;
    frame = std::max(frame.value_or(0), summary.last_frame_index);
  }
  return frame;
}

/// Clear looks, each of which takes that share of the decay, until the existence is below the
/// threshold.
std::optional<std::uint32_t> looks_until_removed(const Object& object,
                                                 const AbsenceOptions& absence,
                                                 double share) {
  const double decay = share * absence.absent_decay.value();
  if (absence.removal != RemovalRule::kExistence || decay <= 0.0) return std::nullopt;
  const double excess = (object.existence - absence.min_existence).value();
  return excess < 0.0 ? 0U : static_cast<std::uint32_t>(std::floor(excess / decay)) + 1U;
}

Removal removal_of(const Object& object, const GoneRule& gone, const AbsenceOptions& absence) {
  Removal removal{.clear_looks = absence_run(object.observation_log),
                  .looks_until_gone = std::nullopt,
                  .looks_until_removed = looks_until_removed(object, absence, 1.0),
                  .looks_until_removed_unseen =
                      looks_until_removed(object, absence, absence.unseen_side_factor)};
  if (absence.removal == RemovalRule::kConfidence) {
    removal.threshold =
        Removal::Threshold{.confidence = object_confidence(object, absence.confidence),
                           .removed_below = absence.min_confidence};
  }
  if (gone.looks == 0) return removal;
  const GoneRule rule = gone_rule_for(object.observation_log.num_detections(), gone);
  const std::uint32_t looks = removal.clear_looks.looks;
  const bool is_gone_now = is_gone(object.observation_log, gone);
  const std::uint32_t missing = rule.looks > looks ? rule.looks - looks : 1U;
  removal.looks_until_gone = is_gone_now ? 0U : missing;
  removal.seconds_until_gone = is_gone_now ? 0.0 : rule.seconds;
  return removal;
}

/// Factors that are nearer to 1 say nothing: maps of before such were left out have 1 - 1e-16.
constexpr double kLeastPriorChange = 1e-6;

std::optional<PriorFactors> prior_factors_of(const Object& object,
                                             std::span<const ClassEvidence> classes) {
  if (object.prior.empty() || classes.size() < 2) return std::nullopt;
  const PriorFactors factors{
      .best = object.prior.factor(classes[0].id),
      .runner_up = object.prior.factor(classes[1].id),
      .is_of_each_observation = object.belief.options().tempering == ClassTempering::kNone};
  const auto is_one = [](double factor) { return std::abs(factor - 1.0) < kLeastPriorChange; };
  if (is_one(factors.best) && is_one(factors.runner_up)) return std::nullopt;
  return factors;
}

}  // namespace

std::optional<Explanation> explain(const ObjectMap& objects,
                                   ObjectId id,
                                   const ConfirmationOptions& confirmation,
                                   const AbsenceOptions& absence) {
  const Object* object = objects.find(id);
  if (object == nullptr) return std::nullopt;
  const ObservationLogState& log = object->observation_log.state();
  Explanation out{.id = id,
                  .beliefs = object_beliefs(*object),
                  .confidence = object_confidence(*object, confirmation.confidence),
                  .missed_conditions = {},
                  .first = log.first,
                  .newest = std::nullopt,
                  .last_seen = newest_detection(log),
                  .last_seen_frame = newest_detection_frame(log),
                  .namings = namings_of(log),
                  .directions = directions_of(log),
                  .missed_detections = missed_detections_of(log),
                  .removal = removal_of(*object, confirmation.gone, absence)};
  out.prior = prior_factors_of(*object, out.beliefs.classes);
  if (!log.newest.empty()) out.newest = log.newest.back();
  if (out.last_seen) out.last_seen_frame = out.last_seen->frame_index;
  for (ConfirmationResult& result : confirmation_results(objects, confirmation)) {
    if (result.id == id) out.missed_conditions = std::move(result.missed);
  }
  return out;
}

}  // namespace hypermap

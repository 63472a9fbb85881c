// SPDX-License-Identifier: BSD-3-Clause
// What an object's evidence says with which probability.
#include "hypermap/core/objects/object.hpp"
#include "hypermap/core/objects/object_beliefs.hpp"
#include "objects/evidence/gone_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace hypermap {
namespace {

/// Coefficients of P(real), of the natural logarithms of what they are named after. Fitted by
/// `scripts/fit_real_probability` to rooms and seeds that no reported figure is of.
constexpr double kRealIntercept = -0.08;
constexpr double kRealPerDetections = 2.62;
constexpr double kRealPerDirections = 1.52;
constexpr double kRealPerMissedVisibility = -2.18;  ///< Of 1 + it.
/// Of the share of the detections that name another class; no logarithm.
constexpr double kRealPerNamedOtherwise = -4.76;
/// What was detected once and never again is a false alarm more often than the rest lets expect.
constexpr double kRealDetectedOnce = -2.47;

/// Weight of all classes together that no detection named.
constexpr double kNeverNamed = 0.2;

using DirectionCounts = std::array<std::uint64_t, ObservationLog::kNumBearingBins>;

/// Detections of each class in each direction.
std::map<ClassId, DirectionCounts> named_classes(const ObservationLog& log) {
  std::map<ClassId, DirectionCounts> counts;
  for (const ObservationLogSummary& s : log.state().summaries) {
    if (s.kind == ObservationKind::kDetection) counts[s.class_id][s.bearing_bin] += s.count;
  }
  return counts;
}

/// The square of what the views say: each has the square root of its detections to share out.
double weight_of(const DirectionCounts& of_class, const DirectionCounts& of_all) {
  double sum = 0.0;
  for (std::size_t view = 0; view < of_all.size(); ++view) {
    if (of_class[view] == 0) continue;
    sum += static_cast<double>(of_class[view]) / std::sqrt(static_cast<double>(of_all[view]));
  }
  return sum * sum;
}

/// Classes of the belief and of the log, each once, ascending, with weights that need not sum to 1.
std::map<ClassId, double> view_weights(const Object& object) {
  const auto named = named_classes(object.observation_log);
  DirectionCounts of_all{};
  for (const auto& [id, counts] : named) {
    for (std::size_t view = 0; view < counts.size(); ++view) of_all[view] += counts[view];
  }
  std::map<ClassId, double> weights;
  std::size_t num_never_named = 0;
  for (const ClassLogOdds& entry : object.belief.entries()) {
    num_never_named += named.contains(entry.id) ? 0U : 1U;
    weights.emplace(entry.id, 0.0);
  }
  for (auto& [id, weight] : weights) weight = kNeverNamed / static_cast<double>(num_never_named);
  for (const auto& [id, counts] : named) weights[id] = weight_of(counts, of_all);
  return weights;
}

bool has_detections(const ObservationLog& log) {
  return std::ranges::any_of(log.state().summaries, [](const ObservationLogSummary& s) {
    return s.kind == ObservationKind::kDetection;
  });
}

bool is_read_by_views(const Object& object) {
  return object.belief.options().tempering == ClassTempering::kViews &&
         has_detections(object.observation_log);
}

/// Order of an object's classes: the less probable is less, of equals the less believed in.
struct LessLikely {
  const ClassBelief& belief;

  bool operator()(const ClassEvidence& a, const ClassEvidence& b) const {
    return std::tuple(a.probability, belief.log_odds(a.id)) <
           std::tuple(b.probability, belief.log_odds(b.id));
  }
};

std::optional<ClassEvidence> most_likely(std::span<const ClassEvidence> classes,
                                         const ClassBelief& belief) {
  if (classes.empty()) return std::nullopt;
  return *std::ranges::max_element(classes, LessLikely{belief});
}

/// Requires: at least one detection.
double regularity_log_odds(const DetectionRegularity& seen) {
  const auto num_detections = static_cast<double>(seen.num_detections);
  return kRealIntercept + kRealPerDetections * std::log(num_detections) +
         kRealPerDirections * std::log(static_cast<double>(seen.num_directions)) +
         kRealPerMissedVisibility * std::log1p(seen.missed_visibility) +
         kRealPerNamedOtherwise * static_cast<double>(seen.num_named_otherwise) / num_detections +
         (seen.num_detections == 1 ? kRealDetectedOnce : 0.0);
}

/// Of what is real with `real` and, if so, most likely of class `best`.
Probability confidence_of(Probability real, const std::optional<ClassEvidence>& best) {
  return Probability(best ? real.value() * best->probability.value() : 0.0);
}

}  // namespace

std::vector<ClassEvidence> class_distribution(const Object& object) {
  if (object.belief.options().tempering == ClassTempering::kNone)
    return object.belief.distribution();
  return with_prior(detected_distribution(object), object.prior);
}

std::vector<ClassEvidence> detected_distribution(const Object& object) {
  if (!is_read_by_views(object)) return object.belief.distribution();
  const auto weights = view_weights(object);
  double sum = 0.0;
  for (const auto& [id, weight] : weights) sum += weight;
  std::vector<ClassEvidence> distribution;
  distribution.reserve(weights.size());
  for (const auto& [id, weight] : weights) {
    distribution.push_back({id, Probability(std::min(1.0, weight / sum))});
  }
  return distribution;
}

std::optional<ClassEvidence> best_class(const Object& object) {
  return most_likely(class_distribution(object), object.belief);
}

std::optional<ClassEvidence> best_detected_class(const Object& object) {
  return most_likely(detected_distribution(object), object.belief);
}

std::optional<double> entropy_nats(std::span<const ClassEvidence> distribution) {
  if (distribution.empty()) return std::nullopt;
  double sum = 0.0;
  for (const ClassEvidence& c : distribution) {
    const double p = c.probability.value();
    if (p > 0.0) sum -= p * std::log(p);
  }
  return sum;
}

Probability real_probability(const Object& object) {
  const DetectionRegularity seen = detection_regularity(object.observation_log);
  if (seen.num_detections == 0) return object.existence.probability();
  double log_odds = regularity_log_odds(seen);
  const AbsenceRun run = absence_run(object.observation_log);
  if (is_gone_by(run, gone_rule_for(seen.num_detections, {})))
    log_odds = std::min(log_odds, -static_cast<double>(run.looks));
  return LogOdds(log_odds).probability();
}

Probability object_confidence(const Object& object, const ObjectConfidenceOptions& options) {
  if (options.rule == ConfidenceRule::kRealAndClass) {
    return confidence_of(real_probability(object), best_class(object));
  }
  const auto best = object.belief.best();
  const double tp1 = best ? best->log_odds.probability().value() : 0.0;
  const double tp2 = object.box_confidence.probability().value();
  const double tp3 = object.histogram.confidence();
  const double p = options.rule == ConfidenceRule::kWeighted ? (4.0 * tp1 + tp2 + tp3) / 6.0
                                                             : tp3 * (4.0 * tp1 + tp2) / 5.0;
  return Probability(std::clamp(p, 0.0, 1.0));
}

ObjectBeliefs object_beliefs(const Object& object) {
  std::vector<ClassEvidence> classes = class_distribution(object);
  std::erase_if(classes, [](const ClassEvidence& c) { return c.probability.value() <= 0.0; });
  // Descending, and equals stay in ascending order of ids.
  std::ranges::stable_sort(classes, [&](const ClassEvidence& a, const ClassEvidence& b) {
    return LessLikely{object.belief}(b, a);
  });
  const Probability real = real_probability(object);
  const auto best = classes.empty() ? std::nullopt : std::optional(classes.front());
  const auto entropy = entropy_nats(classes);
  return {.classes = std::move(classes),
          .class_entropy_nats = entropy,
          .real = real,
          .confidence = confidence_of(real, best)};
}

std::string best_class_name(const Object& object, const ClassRegistry& classes) {
  const auto best = best_class(object);
  return best ? classes.name(best->id) : "unknown";
}

}  // namespace hypermap

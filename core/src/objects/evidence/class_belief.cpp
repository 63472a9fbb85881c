// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/class_belief.hpp"

#include "hypermap/core/base/number_text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

namespace hypermap {
namespace {

LogOdds clamped(LogOdds l, const ClassBeliefOptions& options) {
  return std::clamp(l, options.min_log_odds, options.max_log_odds);
}

bool has_lower_id(const ClassLogOdds& a, const ClassLogOdds& b) {
  return a.id < b.id;
}

}  // namespace

Result<ClassBelief> ClassBelief::create(const ClassBeliefOptions& options) {
  HYPERMAP_TRY(validate(options));
  ClassBelief belief;
  belief.options_ = options;
  return belief;
}

Result<ClassBelief> ClassBelief::from_entries(const ClassBeliefOptions& options,
                                              std::vector<ClassLogOdds> entries) {
  HYPERMAP_ASSIGN_OR_RETURN(ClassBelief belief, create(options));
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const double l = entries[i].log_odds.value();
    if (!(l >= options.min_log_odds.value() && l <= options.max_log_odds.value())) {
      return fail(ErrorCode::kInvalidArgument,
                  "must be within the bounds, is " + number_text(l),
                  "belief[" + std::to_string(i) + "]");
    }
    if (i > 0 && !has_lower_id(entries[i - 1], entries[i])) {
      return fail(ErrorCode::kInvalidArgument,
                  "class ids must ascend, found " + std::to_string(entries[i].id.value),
                  "belief[" + std::to_string(i) + "]");
    }
  }
  belief.entries_ = std::move(entries);
  return belief;
}

LogOdds& ClassBelief::entry(ClassId id) {
  const ClassLogOdds unobserved{id, LogOdds{}};
  auto it = std::lower_bound(entries_.begin(), entries_.end(), unobserved, has_lower_id);
  if (it == entries_.end() || it->id != id) it = entries_.insert(it, unobserved);
  return it->log_odds;
}

void ClassBelief::observe(std::span<const ClassEvidence> evidence,
                          Probability prior,
                          double scale) {
  assert(prior.value() > 0.0 && prior.value() < 1.0);
  const LogOdds expected = LogOdds::of(prior);
  for (const auto& [id, probability] : evidence) {
    // Held within the bounds first: a detector that says p = 1 must not write infinity.
    const LogOdds said = clamped(LogOdds::of(probability), options_);
    entry(id) += scale * (said - expected);
  }
  saturate();
}

void ClassBelief::weaken(LogOdds decay) {
  assert(decay.value() >= 0.0);
  for (ClassLogOdds& e : entries_) e.log_odds -= decay;
  saturate();
}

void ClassBelief::merge(const ClassBelief& other, double scale) {
  for (const auto& [id, log_odds] : other.entries_) entry(id) += scale * log_odds;
  saturate();
}

void ClassBelief::saturate() {
  const auto top = best();
  if (options_.saturation == Saturation::kShift && top && top->log_odds > options_.max_log_odds) {
    const LogOdds excess = top->log_odds - options_.max_log_odds;
    for (ClassLogOdds& e : entries_) e.log_odds -= excess;
  }
  for (ClassLogOdds& e : entries_) e.log_odds = clamped(e.log_odds, options_);
}

LogOdds ClassBelief::log_odds(ClassId id) const {
  const auto it =
      std::lower_bound(entries_.begin(), entries_.end(), ClassLogOdds{id, LogOdds{}}, has_lower_id);
  return it == entries_.end() || it->id != id ? LogOdds{} : it->log_odds;
}

std::optional<ClassLogOdds> ClassBelief::best() const {
  if (entries_.empty()) return std::nullopt;
  return *std::max_element(
      entries_.begin(), entries_.end(), [](const ClassLogOdds& a, const ClassLogOdds& b) {
        return a.log_odds < b.log_odds;
      });
}

std::vector<ClassEvidence> ClassBelief::distribution() const {
  const auto top = best();
  std::vector<double> weights;
  double sum = 0.0;
  for (const ClassLogOdds& e : entries_) {
    weights.push_back(std::exp(e.log_odds.value() - top->log_odds.value()));
    sum += weights.back();
  }
  std::vector<ClassEvidence> out;
  out.reserve(entries_.size());
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    out.push_back({entries_[i].id, Probability(std::min(1.0, weights[i] / sum))});
  }
  return out;
}

}  // namespace hypermap

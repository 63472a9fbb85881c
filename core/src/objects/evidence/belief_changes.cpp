// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/objects/belief_changes.hpp"

#include "objects/evidence/in_thousandths.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace hypermap {
namespace {

bool is_kept(const BeliefChange& change) {
  return change.log_odds != 0.0F;
}

bool is_larger(const BeliefChange& a, const BeliefChange& b) {
  return std::abs(a.log_odds) > std::abs(b.log_odds);
}

bool is_noticeable(const BeliefChange& change) {
  return std::abs(change.log_odds) >= static_cast<float>(BeliefChanges::kLeastLogOdds);
}

/// A change and the belief before it, which decides between changes of one size.
struct ChangedBelief {
  BeliefChange change;
  LogOdds before;
};

bool comes_first(const ChangedBelief& a, const ChangedBelief& b) {
  if (is_larger(a.change, b.change) || is_larger(b.change, a.change))
    return is_larger(a.change, b.change);
  return a.before > b.before || (a.before == b.before && a.change.class_id < b.change.class_id);
}

}  // namespace

BeliefChanges BeliefChanges::between(std::span<const ClassLogOdds> before,
                                     std::span<const ClassLogOdds> after,
                                     ClassId named) {
  std::array<ChangedBelief, kMaxClasses> largest = {};
  auto old = before.begin();
  for (const auto& [id, log_odds] : after) {
    const bool is_old = old != before.end() && old->id == id;
    const LogOdds was = is_old ? (old++)->log_odds : LogOdds{};
    const ChangedBelief changed{{id, in_thousandths((log_odds - was).value())}, was};
    if (id == named || !is_noticeable(changed.change)) continue;
    if (!comes_first(changed, largest.back())) continue;
    largest.back() = changed;
    for (std::size_t i = kMaxClasses - 1; i > 0 && comes_first(largest[i], largest[i - 1]); --i)
      std::swap(largest[i], largest[i - 1]);
  }
  BeliefChanges out;
  std::ranges::transform(largest, out.changes_.begin(), &ChangedBelief::change);
  return out;
}

Result<BeliefChanges> BeliefChanges::from_entries(std::span<const BeliefChange> entries) {
  const auto refuse = [](const std::string& what) {
    return fail(ErrorCode::kInvalidArgument, what, "belief_changes");
  };
  if (entries.size() > kMaxClasses) {
    return refuse("must be of at most " + std::to_string(kMaxClasses) + " classes, are of " +
                  std::to_string(entries.size()));
  }
  BeliefChanges out;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::string id = std::to_string(entries[i].class_id.value);
    if (!std::isfinite(entries[i].log_odds) || !is_kept(entries[i]))
      return refuse("must be finite and not 0, that of class " + id + " is not");
    if (out.contains(entries[i].class_id))
      return refuse("must have a class once, have " + id + " twice");
    if (i > 0 && is_larger(entries[i], entries[i - 1]))
      return refuse("must have the larger first, that of class " + id +
                    " is larger than the one before");
    out.changes_[i] = entries[i];
  }
  return out;
}

void BeliefChanges::add(const BeliefChanges& later) {
  BeliefChanges sums;
  const auto more = later.entries();
  for (const BeliefChange& change : entries()) {
    const auto same = std::ranges::find(more, change.class_id, &BeliefChange::class_id);
    const double by = same == more.end() ? 0.0 : static_cast<double>(same->log_odds);
    sums.insert({change.class_id, in_thousandths(static_cast<double>(change.log_odds) + by)});
  }
  for (const BeliefChange& change : more) {
    if (!contains(change.class_id)) sums.insert(change);
  }
  *this = sums;
}

void BeliefChanges::insert(const BeliefChange& change) {
  if (!is_noticeable(change)) return;
  const auto at = std::ranges::upper_bound(changes_, change, is_larger);
  if (at == changes_.end()) return;
  std::move_backward(at, changes_.end() - 1, changes_.end());
  *at = change;
}

std::span<const BeliefChange> BeliefChanges::entries() const noexcept {
  const auto end = std::ranges::find_if_not(changes_, is_kept);
  return {changes_.begin(), end};
}

bool BeliefChanges::contains(ClassId id) const noexcept {
  return std::ranges::any_of(entries(),
                             [id](const BeliefChange& change) { return change.class_id == id; });
}

}  // namespace hypermap

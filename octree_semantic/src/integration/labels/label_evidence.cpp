// SPDX-License-Identifier: BSD-3-Clause
#include "label_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace hypermap {
namespace {

/// Three kept classes may hide the three strongest; one more bounds all others.
constexpr std::size_t kNumBest = 2 * VoxelLabel::kNumClasses + 1;
/// Class ids up to here have a table; larger ones are handled voxel by voxel.
constexpr std::size_t kMaxTable = 4096;
/// Beyond every clamp: stands for certainty.
constexpr double kCertain = 60'000.0;

bool stronger(const ScoredClass& a, const ScoredClass& b) {
  return a.evidence > b.evidence || (a.evidence == b.evidence && a.class_id < b.class_id);
}

bool more_probable(const ClassEvidence& a, const ClassEvidence& b) {
  return a.probability > b.probability || (a.probability == b.probability && a.id < b.id);
}

bool keeps(const VoxelLabel& label, ClassId id) {
  return std::any_of(label.classes.begin(), label.classes.end(), [&](const ClassWeight& kept) {
    return kept.class_id == id.value;
  });
}

/// logit(p) - logit(1/N) = ln(p / (1 - p)) + ln(N - 1), for N = 1 as for two classes.
std::int32_t evidence_of(double probability, std::size_t num_classes) {
  const double prior = std::log(static_cast<double>(std::max<std::size_t>(num_classes, 2) - 1));
  const double milli = 1000.0 * (LogOdds::of(Probability(probability)).value() + prior);
  return static_cast<std::int32_t>(std::lround(std::clamp(milli, -kCertain, kCertain)));
}

/// Appends the evidence of a class vector. No allocation within reserved capacity.
void append_scored(std::span<const ClassEvidence> scores,
                   std::vector<ScoredClass>& by_id,
                   std::vector<ScoredClass>& best) {
  const std::size_t first = by_id.size();
  for (const ClassEvidence& score : scores) {
    by_id.push_back({static_cast<std::uint16_t>(score.id.value),
                     evidence_of(score.probability.value(), scores.size())});
  }
  std::array<ScoredClass, kNumBest> strongest;
  const auto end = std::partial_sort_copy(by_id.begin() + static_cast<std::ptrdiff_t>(first),
                                          by_id.end(),
                                          strongest.begin(),
                                          strongest.end(),
                                          stronger);
  best.insert(best.end(), strongest.begin(), end);
}

std::int32_t clamped(std::int32_t value, std::int32_t limit) {
  return std::clamp(value, -limit, limit);
}

/// One observation says at most `limit`.
MilliLogOdds sum_of(std::int32_t log_odds, std::int32_t evidence, MilliLogOdds limit) {
  constexpr std::int32_t kMaxSum = 32'767;
  return static_cast<MilliLogOdds>(clamped(log_odds + clamped(evidence, limit), kMaxSum));
}

}  // namespace

void LabelEvidence::start(std::span<const PixelLabels> labels) {
  labels_ = labels;
  scored_.by_id.clear();
  scored_.best.clear();
  prepared_.clear();
  tables_.clear();
  for (const PixelLabels& label : labels) {
    Prepared prepared{{scored_.by_id.size(), 0}, {scored_.best.size(), 0}, {}};
    append_scored(label.class_scores, scored_.by_id, scored_.best);
    prepared.by_id.count = scored_.by_id.size() - prepared.by_id.first;
    prepared.best.count = scored_.best.size() - prepared.best.first;
    prepared.table = append_table(prepared.by_id);
    prepared_.push_back(prepared);
  }
  best_ids_.clear();
  best_evidence_.clear();
  for (const ScoredClass& best : scored_.best) {
    best_ids_.push_back(best.class_id);
    best_evidence_.push_back(best.evidence);
  }
  sum_.reserve(scored_.by_id.size());
  merged_.reserve(scored_.by_id.size());
  mixed_.by_id.reserve(scored_.by_id.size());
  mixed_.best.reserve(kNumBest);
}

LabelEvidence::Range LabelEvidence::append_table(const Range& by_id) {
  const auto scored = std::span(scored_.by_id).subspan(by_id.first, by_id.count);
  const std::size_t size = scored.empty() ? 0 : std::size_t{scored.back().class_id} + 1;
  const Range table{tables_.size(), size > kMaxTable ? 0 : size};
  tables_.resize(tables_.size() + table.count, kernels::kNotNamed);
  if (table.count == 0) return table;
  for (const ScoredClass& one : scored) tables_[table.first + one.class_id] = one.evidence;
  return table;
}

std::optional<kernels::LabelScores> LabelEvidence::scores_of(std::uint32_t label,
                                                             MilliLogOdds limit) const noexcept {
  const Prepared& prepared = prepared_[label];
  if (prepared.table.count == 0) return std::nullopt;
  return kernels::LabelScores{.by_class = &tables_[prepared.table.first],
                              .num_classes = static_cast<std::int32_t>(prepared.table.count),
                              .best_ids = &best_ids_[prepared.best.first],
                              .best = &best_evidence_[prepared.best.first],
                              .num_best = prepared.best.count,
                              .limit = limit};
}

VoxelEvidence LabelEvidence::of(std::span<const LabelVote> votes,
                                const VoxelLabel& label) noexcept {
  ObjectId object = kNoObject;
  std::uint32_t most = 0;
  for (const LabelVote& vote : votes) {
    const ObjectId candidate = labels_[vote.label].object;
    std::uint32_t count = 0;
    for (const LabelVote& other : votes) {
      if (labels_[other.label].object == candidate) count += other.count;
    }
    const bool wins = count > most || (count == most && candidate < object);
    if (candidate != kNoObject && wins) {
      object = candidate;
      most = count;
    }
  }
  if (votes.size() != 1) return mixed(votes, label, object);
  const Prepared& prepared = prepared_[votes.front().label];
  return {std::span(scored_.by_id).subspan(prepared.by_id.first, prepared.by_id.count),
          std::span(scored_.best).subspan(prepared.best.first, prepared.best.count),
          object};
}

void LabelEvidence::average(std::span<const LabelVote> votes) noexcept {
  double total = 0.0;
  for (const LabelVote& vote : votes) {
    if (!labels_[vote.label].class_scores.empty()) total += vote.count;
  }
  sum_.clear();
  for (const LabelVote& vote : votes) {
    const double share = total > 0.0 ? vote.count / total : 0.0;
    merged_.clear();
    const std::span<const ClassEvidence> scores = labels_[vote.label].class_scores;
    auto a = sum_.begin();
    auto b = scores.begin();
    while (a != sum_.end() || b != scores.end()) {
      const bool from_a = b == scores.end() || (a != sum_.end() && a->id <= b->id);
      const bool from_b = a == sum_.end() || (b != scores.end() && b->id <= a->id);
      const ClassId id = from_a ? a->id : b->id;
      const double sum = (from_a ? (a++)->probability.value() : 0.0) +
                         (from_b ? share * (b++)->probability.value() : 0.0);
      merged_.push_back({id, Probability(std::min(sum, 1.0))});
    }
    std::swap(sum_, merged_);
  }
}

VoxelEvidence LabelEvidence::mixed(std::span<const LabelVote> votes,
                                   const VoxelLabel& label,
                                   ObjectId object) noexcept {
  average(votes);
  mixed_.by_id.clear();
  mixed_.best.clear();
  const auto score = [&](const ClassEvidence& one) {
    return ScoredClass{static_cast<std::uint16_t>(one.id.value),
                       evidence_of(one.probability.value(), sum_.size())};
  };
  // Logarithms only of those that count: the more probable, the stronger.
  std::array<ClassEvidence, kNumBest> likeliest;
  const auto end = std::partial_sort_copy(
      sum_.begin(), sum_.end(), likeliest.begin(), likeliest.end(), more_probable);
  std::transform(likeliest.begin(), end, std::back_inserter(mixed_.best), score);
  std::sort(mixed_.best.begin(), mixed_.best.end(), stronger);
  for (const ClassEvidence& one : sum_) {
    if (keeps(label, one.id)) mixed_.by_id.push_back(score(one));
  }
  return {mixed_.by_id, mixed_.best, object};
}

namespace {

/// Adds what the frame says about the classes already kept.
void observe_kept(VoxelLabel& label, std::span<const ScoredClass> by_id, MilliLogOdds limit) {
  for (ClassWeight& kept : label.classes) {
    if (kept.class_id == ClassWeight::kNone) continue;
    const auto found = std::lower_bound(
        by_id.begin(), by_id.end(), kept.class_id, [](const ScoredClass& a, std::uint16_t id) {
          return a.class_id < id;
        });
    if (found == by_id.end() || found->class_id != kept.class_id) continue;
    kept.log_odds = sum_of(kept.log_odds, found->evidence, limit);
  }
}

bool better(const ClassWeight& a, const ClassWeight& b) {
  if (a.class_id == ClassWeight::kNone || b.class_id == ClassWeight::kNone) {
    return b.class_id == ClassWeight::kNone && a.class_id != ClassWeight::kNone;
  }
  return a.log_odds > b.log_odds || (a.log_odds == b.log_odds && a.class_id < b.class_id);
}

/// Lowers all by what the best has above the limit, and holds them within it.
void saturate(VoxelLabel& label, MilliLogOdds limit) {
  const std::int32_t excess = std::max(label.classes.front().log_odds - limit, 0);
  const auto shifted = [&](MilliLogOdds value) {
    return static_cast<MilliLogOdds>(clamped(value - excess, limit));
  };
  for (ClassWeight& kept : label.classes) {
    if (kept.class_id != ClassWeight::kNone) kept.log_odds = shifted(kept.log_odds);
  }
  label.rest = shifted(label.rest);
  // Those that meet at the lower bound are equals now, in the order of their ids.
  std::sort(label.classes.begin(), label.classes.end(), better);
}

}  // namespace

void observe(VoxelLabel& label, const VoxelEvidence& evidence, MilliLogOdds limit) noexcept {
  label.vote(evidence.object);
  if (evidence.best.empty()) return;
  observe_kept(label, evidence.by_id, limit);
  std::array<ClassWeight, 2 * VoxelLabel::kNumClasses + 1> pool;
  std::copy(label.classes.begin(), label.classes.end(), pool.begin());
  std::size_t num_pool = label.classes.size();
  for (const ScoredClass& candidate : evidence.best) {
    const auto is_candidate = [&candidate](const ClassWeight& kept) {
      return kept.class_id == candidate.class_id;
    };
    if (std::any_of(label.classes.begin(), label.classes.end(), is_candidate)) continue;
    if (num_pool == pool.size()) break;
    pool[num_pool++] = {candidate.class_id, sum_of(label.rest, candidate.evidence, limit)};
  }
  std::sort(pool.begin(), pool.end(), better);  // unused places come last
  std::copy_n(pool.begin(), label.classes.size(), label.classes.begin());
  const ClassWeight& best_of_rest = pool[label.classes.size()];
  if (best_of_rest.class_id != ClassWeight::kNone) label.rest = best_of_rest.log_odds;
  saturate(label, limit);
}

}  // namespace hypermap

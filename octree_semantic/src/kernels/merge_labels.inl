// SPDX-License-Identifier: BSD-3-Clause
// Adds one frame's evidence to the beliefs of voxels, a voxel in each lane.
#if defined(HYPERMAP_MERGE_LABELS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HYPERMAP_MERGE_LABELS_INL
#undef HYPERMAP_MERGE_LABELS_INL
#else
#define HYPERMAP_MERGE_LABELS_INL
#endif

#include "kernels/kernels.hpp"

#include <hwy/highway.h>

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace hypermap::kernels {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using BeliefInts = hn::CappedTag<std::int32_t, 16>;
using Beliefs = hn::Vec<BeliefInts>;

/// So that a sum and the id of its class are one number.
constexpr std::int32_t kMaxSum = 32'767;
/// Three places, and the bound of the rest, can be won by so many.
constexpr std::int32_t kMaxRivals = 4;

HWY_INLINE Beliefs id_of(Beliefs ranked) {
  const BeliefInts d;
  return hn::AndNot(ranked, hn::Set(d, 0xFFFF));
}

HWY_INLINE Beliefs held_within(Beliefs value, std::int32_t limit) {
  const BeliefInts d;
  return hn::Min(hn::Max(value, hn::Set(d, -limit)), hn::Set(d, limit));
}

/// One observation says at most `limit`.
HWY_INLINE Beliefs sum_of(Beliefs log_odds, Beliefs evidence, std::int32_t limit) {
  return held_within(hn::Add(log_odds, held_within(evidence, limit)), kMaxSum);
}

/// The number of a class with other log-odds.
HWY_INLINE Beliefs ranked_with(Beliefs log_odds, Beliefs ranked) {
  return hn::Or(hn::ShiftLeft<16>(log_odds), hn::And(ranked, hn::Set(BeliefInts(), 0xFFFF)));
}

/// What the frame says of a class that is kept.
HWY_INLINE Beliefs observed(const LabelScores& scores, Beliefs ranked) {
  const BeliefInts d;
  const auto id = id_of(ranked);
  const auto in_table = hn::Lt(id, hn::Set(d, scores.num_classes));
  const auto evidence = hn::GatherIndex(d, scores.by_class, hn::IfThenElseZero(in_table, id));
  const auto named = hn::And(in_table, hn::Ne(evidence, hn::Set(d, kNotNamed)));
  const auto sum = sum_of(hn::ShiftRight<16>(ranked), evidence, scores.limit);
  return hn::IfThenElse(named, ranked_with(sum, ranked), ranked);
}

/// A class when all are lowered by `excess`.
HWY_INLINE Beliefs shifted(Beliefs ranked, Beliefs excess, std::int32_t limit) {
  const BeliefInts d;
  const auto log_odds = held_within(hn::Sub(hn::ShiftRight<16>(ranked), excess), limit);
  return hn::IfThenElse(
      hn::Eq(ranked, hn::Set(d, kNoClass)), ranked, ranked_with(log_odds, ranked));
}

/// The voxels of one vector, from voxel `i` on.
HWY_INLINE void merge_beliefs(const LabelScores& scores, std::size_t i, BeliefLanes& beliefs) {
  const BeliefInts d;
  const auto kept_0 = hn::Load(d, beliefs.classes[0] + i);
  const auto kept_1 = hn::Load(d, beliefs.classes[1] + i);
  const auto kept_2 = hn::Load(d, beliefs.classes[2] + i);
  const auto rest = hn::Load(d, beliefs.rest + i);
  const auto a = observed(scores, kept_0);
  const auto b = observed(scores, kept_1);
  const auto c = observed(scores, kept_2);
  // The first four of all, sorted.
  const auto none = hn::Set(d, kNoClass);
  auto first = hn::Max(hn::Max(a, b), c);
  auto second = hn::Max(hn::Min(a, b), hn::Min(hn::Max(a, b), c));
  auto third = hn::Min(hn::Min(a, b), c);
  auto fourth = none;
  auto num_rivals = hn::Zero(d);
  for (std::size_t rival = 0; rival < scores.num_best; ++rival) {
    const auto id = hn::Set(d, scores.best_ids[rival]);
    const auto is_kept = hn::Or(hn::Eq(id_of(kept_0), id),
                                hn::Or(hn::Eq(id_of(kept_1), id), hn::Eq(id_of(kept_2), id)));
    const auto competes =
        hn::AndNot(is_kept, hn::Lt(num_rivals, hn::Set(d, kMaxRivals)));
    num_rivals = hn::Add(num_rivals, hn::IfThenElseZero(competes, hn::Set(d, 1)));
    const auto sum = sum_of(rest, hn::Set(d, scores.best[rival]), scores.limit);
    auto rank = ranked_with(sum, hn::Set(d, 0xFFFF - scores.best_ids[rival]));
    rank = hn::IfThenElse(competes, rank, none);
    const auto sink = [&rank](Beliefs place) {
      const auto better = hn::Max(place, rank);
      rank = hn::Min(place, rank);
      return better;
    };
    first = sink(first);
    second = sink(second);
    third = sink(third);
    fourth = sink(fourth);
  }
  const auto other = hn::IfThenElse(hn::Eq(fourth, none), rest, hn::ShiftRight<16>(fourth));
  const auto excess =
      hn::Max(hn::Sub(hn::ShiftRight<16>(first), hn::Set(d, scores.limit)), hn::Zero(d));
  // Those that meet at the lower bound are equals now, in the order of their ids.
  const auto x = shifted(first, excess, scores.limit);
  const auto y = shifted(second, excess, scores.limit);
  const auto z = shifted(third, excess, scores.limit);
  hn::Store(hn::Max(hn::Max(x, y), z), d, beliefs.classes[0] + i);
  hn::Store(hn::Max(hn::Min(x, y), hn::Min(hn::Max(x, y), z)), d, beliefs.classes[1] + i);
  hn::Store(hn::Min(hn::Min(x, y), z), d, beliefs.classes[2] + i);
  hn::Store(held_within(hn::Sub(other, excess), scores.limit), d, beliefs.rest + i);
}

inline void merge_labels(const LabelScores& scores, std::size_t size, BeliefLanes& beliefs) {
  for (std::size_t i = 0; i < size; i += hn::Lanes(BeliefInts())) {
    merge_beliefs(scores, i, beliefs);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace hypermap::kernels
HWY_AFTER_NAMESPACE();

#endif

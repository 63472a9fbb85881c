// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/voxel_label.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr std::uint16_t kMaxVotes = 10;

bool in_order(const ClassWeight& a, const ClassWeight& b) {
  if (b.class_id == ClassWeight::kNone) return true;
  if (a.class_id == ClassWeight::kNone) return false;
  return a.log_odds > b.log_odds || (a.log_odds == b.log_odds && a.class_id < b.class_id);
}

struct SummedClass {
  std::uint16_t class_id = 0;
  std::int32_t log_odds = 0;
};

bool is_stronger(const SummedClass& a, const SummedClass& b) {
  return a.log_odds > b.log_odds || (a.log_odds == b.log_odds && a.class_id < b.class_id);
}

/// What a label says of a class, kept or not.
std::int32_t log_odds_of(const VoxelLabel& label, std::uint16_t class_id) {
  const auto kept = std::ranges::find(label.classes, class_id, &ClassWeight::class_id);
  return kept == label.classes.end() ? label.rest : kept->log_odds;
}

/// The classes that either keeps, the strongest first.
std::vector<SummedClass> summed_classes(const VoxelLabel& a, const VoxelLabel& b) {
  std::vector<SummedClass> sums;
  sums.reserve(2 * VoxelLabel::kNumClasses);
  for (const VoxelLabel* label : {&a, &b}) {
    for (const ClassWeight& kept : label->classes) {
      const bool is_new =
          std::ranges::find(sums, kept.class_id, &SummedClass::class_id) == sums.end();
      if (kept.class_id == ClassWeight::kNone || !is_new) continue;
      sums.push_back(
          {kept.class_id, log_odds_of(a, kept.class_id) + log_odds_of(b, kept.class_id)});
    }
  }
  std::ranges::sort(sums, is_stronger);
  return sums;
}

struct ObjectVotes {
  ObjectId object = kNoObject;
  std::uint16_t votes = 0;
};

ObjectVotes summed_votes(const VoxelLabel& a, const VoxelLabel& b) {
  const bool b_is_ahead =
      b.object_votes != a.object_votes ? b.object_votes > a.object_votes : b.object < a.object;
  const bool is_b = a.object == kNoObject || (b.object != kNoObject && b_is_ahead);
  const VoxelLabel& more = is_b ? b : a;
  const VoxelLabel& less = is_b ? a : b;
  const bool agree = less.object == kNoObject || less.object == more.object;
  const int votes = more.object_votes + (agree ? less.object_votes : -less.object_votes);
  return {more.object, std::min(static_cast<std::uint16_t>(votes), kMaxVotes)};
}

bool exceeds(MilliLogOdds value, MilliLogOdds limit) {
  return value < -limit || value > limit;
}

}  // namespace

void VoxelLabel::vote(ObjectId id) noexcept {
  if (id == kNoObject) return;
  if (object_votes == 0) {
    object = id;
    object_votes = 1;
  } else if (object == id) {
    object_votes = std::min<std::uint16_t>(static_cast<std::uint16_t>(object_votes + 1), kMaxVotes);
  } else {
    object_votes = static_cast<std::uint16_t>(object_votes - 1);
  }
}

VoxelLabel sum_of(const VoxelLabel& a, const VoxelLabel& b, MilliLogOdds limit) {
  std::vector<SummedClass> sums = summed_classes(a, b);
  std::int32_t rest = a.rest + b.rest;
  const std::int32_t excess = sums.empty() ? 0 : std::max(sums.front().log_odds - limit, 0);
  const auto held = [&](std::int32_t log_odds) {
    return std::clamp<std::int32_t>(log_odds - excess, -limit, limit);
  };
  for (SummedClass& one : sums) one.log_odds = held(one.log_odds);
  // Those that meet at the lower bound are equals now, in the order of their ids.
  std::ranges::sort(sums, is_stronger);
  VoxelLabel sum;
  const std::size_t num_kept = std::min(sums.size(), sum.classes.size());
  for (std::size_t i = 0; i < num_kept; ++i) {
    sum.classes[i] = {sums[i].class_id, static_cast<MilliLogOdds>(sums[i].log_odds)};
  }
  rest = held(rest);
  if (sums.size() > num_kept) rest = std::max(rest, sums[num_kept].log_odds);
  sum.rest = static_cast<MilliLogOdds>(rest);
  const ObjectVotes votes = summed_votes(a, b);
  sum.object = votes.object;
  sum.object_votes = votes.votes;
  return sum;
}

Result<void> validate(const VoxelLabel& label, MilliLogOdds limit) {
  for (std::size_t i = 0; i < label.classes.size(); ++i) {
    const ClassWeight& weight = label.classes[i];
    if (exceeds(weight.log_odds, limit)) {
      return fail(
          ErrorCode::kInvalidArgument,
          "must lie within +-" + std::to_string(limit) + ", is " + std::to_string(weight.log_odds),
          "classes");
    }
    for (std::size_t j = i + 1; j < label.classes.size(); ++j) {
      const bool duplicate =
          weight.class_id != ClassWeight::kNone && weight.class_id == label.classes[j].class_id;
      if (duplicate || !in_order(weight, label.classes[j])) {
        return fail(ErrorCode::kInvalidArgument,
                    "must be sorted, best first, no class twice, class " +
                        std::to_string(label.classes[j].class_id) + " is not",
                    "classes");
      }
    }
  }
  if (exceeds(label.rest, limit)) {
    return fail(ErrorCode::kInvalidArgument,
                "must lie within +-" + std::to_string(limit) + ", is " + std::to_string(label.rest),
                "rest");
  }
  if (label.object_votes > kMaxVotes || (label.object == kNoObject && label.object_votes != 0)) {
    return fail(
        ErrorCode::kInvalidArgument,
        "must be 0 to 10, and 0 without an object, is " + std::to_string(label.object_votes),
        "object_votes");
  }
  return {};
}

}  // namespace hypermap

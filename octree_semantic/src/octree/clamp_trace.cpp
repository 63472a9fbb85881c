// SPDX-License-Identifier: BSD-3-Clause
#include "octree/clamp_trace.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

constexpr int kMaxUpdates = 64;  // of either kind
constexpr int kUnexplained = std::numeric_limits<int>::max();

/// The least number of updates that lead from `start` to each value, from clamp_min on.
std::vector<int> updates_from(int start, const SensorModel& model) {
  std::vector<int> least(static_cast<std::size_t>(model.clamp_max - model.clamp_min) + 1,
                         kUnexplained);
  for (int hits = 0; hits <= kMaxUpdates; ++hits) {
    for (int misses = 0; misses <= kMaxUpdates; ++misses) {
      const int value = start + hits * model.hit + misses * model.miss;
      if (value < model.clamp_min || value > model.clamp_max) continue;
      int& known = least[static_cast<std::size_t>(value - model.clamp_min)];
      known = std::min(known, hits + misses);
    }
  }
  return least;
}

}  // namespace

ClampTrace::ClampTrace(const SensorModel& model) : clamp_min_(model.clamp_min) {
  const std::vector<int> from_nothing = updates_from(0, model);
  const std::vector<int> from_free = updates_from(model.clamp_min, model);
  const std::vector<int> from_occupied = updates_from(model.clamp_max, model);
  was_clamped_.reserve(from_nothing.size());
  for (std::size_t i = 0; i < from_nothing.size(); ++i) {
    was_clamped_.push_back(std::min(from_free[i], from_occupied[i]) < from_nothing[i]);
  }
}

bool ClampTrace::was_clamped(MilliLogOdds log_odds) const {
  return was_clamped_[static_cast<std::size_t>(log_odds - clamp_min_)];
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "touching_rings.hpp"

#include "exact_orientation.hpp"
#include "ring_check.hpp"

#include <vector>

namespace hypermap {
namespace {

/// A corner of a ring with the ones before and after it.
struct Passage {
  std::size_t ring = 0;
  Eigen::Vector2d before;
  Eigen::Vector2d at;
  Eigen::Vector2d after;
};

std::vector<Passage> passages_of(std::span<const Ring> rings) {
  std::vector<Passage> passages;
  std::size_t num_points = 0;
  for (const Ring& ring : rings) num_points += ring.size();
  passages.reserve(num_points);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const Ring& ring = rings[r];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      passages.push_back({.ring = r,
                          .before = ring[(i + ring.size() - 1) % ring.size()],
                          .at = ring[i],
                          .after = ring[(i + 1) % ring.size()]});
    }
  }
  return passages;
}

/// Whether the way from the passage's corner to `point` leads off to its left, between its edges.
bool is_left_of(const Passage& passage, const Eigen::Vector2d& point) {
  const bool left_of_in = orientation(passage.before, passage.at, point) > 0;
  const bool left_of_out = orientation(passage.at, passage.after, point) > 0;
  const bool turns_left = orientation(passage.before, passage.at, passage.after) >= 0;
  return turns_left ? left_of_in && left_of_out : left_of_in || left_of_out;
}

/// Two passages of one corner that leave the area of the polygon to each other's left.
bool touch_only(const Passage& a, const Passage& b) {
  return is_left_of(a, b.before) && is_left_of(a, b.after) && is_left_of(b, a.before) &&
         is_left_of(b, a.after);
}

/// Edges from `at` to `after` that have more in common than a corner of both.
bool edges_intersect(const Passage& a, const Passage& b) {
  if (a.at == b.at || a.at == b.after || a.after == b.at || a.after == b.after) return false;
  return segments_intersect(a.at, a.after, b.at, b.after);
}

}  // namespace

Result<std::optional<RingPairs>> touching_pairs(std::span<const Ring> rings,
                                                const LoadBudget& budget) {
  const std::vector<Passage> passages = passages_of(rings);
  if (passages.size() > kMaxCrossingPoints) return std::nullopt;
  RingPairs pairs;
  for (std::size_t i = 0; i < passages.size(); ++i) {
    HYPERMAP_TRY(budget.draw_edge_tests(i));
    for (std::size_t k = 0; k < i; ++k) {
      const Passage& a = passages[k];
      const Passage& b = passages[i];
      if (edges_intersect(a, b)) return std::nullopt;
      if (a.at != b.at) continue;
      if (a.ring == b.ring || !touch_only(a, b)) return std::nullopt;
      pairs.emplace(a.ring, b.ring);
    }
  }
  return pairs;
}

}  // namespace hypermap

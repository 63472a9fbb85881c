// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon_budget.hpp"
#include "ring_arrangement.hpp"
#include "ring_check.hpp"
#include "ring_sweep.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace hypermap {
namespace {

Result<void> check_signs(const RingArrangement& plane) {
  const auto [lowest, highest] =
      std::minmax_element(plane.windings().begin(), plane.windings().end());
  if (*lowest < 0 && *highest > 0) {
    return fail(ErrorCode::kInvalidArgument,
                "the ring crosses itself into parts of both orientations (a bow-tie)");
  }
  return {};
}

/// Whether a piece lies wholly outside the area: passed as often one way as the other.
bool has_lines(const RingArrangement& plane) {
  const auto& edges = plane.half_edges();
  for (std::size_t h = 0; h < edges.size(); h += 2) {
    if (edges[h].net == 0 && plane.winding_left_of(h) == 0 && plane.winding_left_of(twin(h)) == 0) {
      return true;
    }
  }
  return false;
}

/// Half-edges with the area on their left and the outside on their right.
std::vector<bool> boundary_of(const RingArrangement& plane) {
  std::vector<bool> is_boundary(plane.half_edges().size(), false);
  for (std::size_t h = 0; h < is_boundary.size(); ++h) {
    is_boundary[h] = plane.winding_left_of(h) != 0 && plane.winding_left_of(twin(h)) == 0;
  }
  return is_boundary;
}

/// Nodes around one piece of area: the next way is the first one clockwise, so that the area
/// between stays whole.
std::vector<std::size_t> walk(const RingArrangement& plane,
                              std::size_t start,
                              std::vector<bool>& is_boundary) {
  const auto& edges = plane.half_edges();
  std::vector<std::size_t> nodes;
  for (std::size_t h = start; is_boundary[h];) {
    is_boundary[h] = false;
    nodes.push_back(edges[h].from);
    const std::size_t back = twin(h);
    std::size_t way = edges[back].next_clockwise;
    while (way != back && way != start && !is_boundary[way]) way = edges[way].next_clockwise;
    h = way;
  }
  return nodes;
}

/// A walk that comes through a node twice is several rings that touch there.
std::vector<Ring> simple_rings(const RingArrangement& plane, std::span<const std::size_t> walked) {
  std::vector<Ring> rings;
  std::vector<std::size_t> open;
  for (const std::size_t node : walked) {
    const auto seen = std::find(open.begin(), open.end(), node);
    if (seen != open.end()) {
      Ring& ring = rings.emplace_back();
      for (auto it = seen; it != open.end(); ++it) ring.push_back(plane.nodes()[*it]);
      open.erase(seen, open.end());
    }
    open.push_back(node);
  }
  Ring& last = rings.emplace_back();
  for (const std::size_t node : open) last.push_back(plane.nodes()[node]);
  return rings;
}

Result<bool> holds(const Polygon& outer, const Ring& ring, const LoadBudget& budget) {
  for (const Eigen::Vector2d& point : ring) {
    HYPERMAP_TRY(budget.draw_edge_tests(outer.outer.size()));
    if (!contains(outer, point)) return false;
  }
  return true;
}

/// Outer rings become polygons, each hole goes to the smallest polygon around it.
Result<std::vector<Polygon>> assemble(const std::vector<Ring>& rings, const LoadBudget& budget) {
  std::vector<Polygon> parts;
  for (const Ring& ring : rings) {
    if (ring.size() >= 3 && signed_area_m2(ring) > 0.0) parts.push_back({ring, {}});
  }
  const std::vector<Polygon> solid = parts;
  for (const Ring& ring : rings) {
    if (ring.size() < 3 || signed_area_m2(ring) >= 0.0) continue;
    Polygon* owner = nullptr;
    for (std::size_t i = 0; i < solid.size(); ++i) {
      HYPERMAP_TRY(budget.draw_edge_tests(solid[i].outer.size()));
      const bool is_nearer = owner == nullptr || area_m2(solid[i]) < area_m2({owner->outer, {}});
      if (!is_nearer) continue;
      HYPERMAP_ASSIGN_OR_RETURN(const bool is_around, holds(solid[i], ring, budget));
      if (is_around) owner = &parts[i];
    }
    if (owner != nullptr) owner->holes.push_back(ring);
  }
  return parts;
}

Eigen::Vector2d lowest_point(const Polygon& polygon) {
  return *std::min_element(
      polygon.outer.begin(), polygon.outer.end(), [](const auto& a, const auto& b) {
        return a.y() < b.y() || (a.y() == b.y() && a.x() < b.x());
      });
}

void sort_by_place(std::vector<Polygon>& parts) {
  std::stable_sort(parts.begin(), parts.end(), [](const Polygon& a, const Polygon& b) {
    const Eigen::Vector2d p = lowest_point(a);
    const Eigen::Vector2d q = lowest_point(b);
    return p.y() < q.y() || (p.y() == q.y() && p.x() < q.x());
  });
}

}  // namespace

Result<WindingFill> resolve_winding(Ring ring, const LoadBudget& budget) {
  if (ring.size() > kMaxPolygonPoints) {
    return fail(ErrorCode::kLimit,
                "has " + std::to_string(ring.size()) + " points, the limit is " +
                    std::to_string(kMaxPolygonPoints));
  }
  HYPERMAP_ASSIGN_OR_RETURN(auto spike_free, without_spikes(std::move(ring)));
  Ring& clean = spike_free.ring;
  if (!first_intersection(std::span(&clean, 1))) {
    HYPERMAP_ASSIGN_OR_RETURN(Polygon simple, make_polygon(std::move(clean), {}, budget));
    return WindingFill{{std::move(simple)}, spike_free.had_spikes};
  }
  if (clean.size() > kMaxCrossingPoints) {
    return fail(ErrorCode::kLimit,
                "the ring crosses itself and has " + std::to_string(clean.size()) +
                    " points, the limit for such rings is " + std::to_string(kMaxCrossingPoints));
  }
  HYPERMAP_ASSIGN_OR_RETURN(const RingArrangement plane, RingArrangement::create(clean, budget));
  HYPERMAP_TRY(check_signs(plane));
  std::vector<bool> is_boundary = boundary_of(plane);
  std::vector<Ring> rings;
  for (std::size_t h = 0; h < is_boundary.size(); ++h) {
    if (!is_boundary[h]) continue;
    for (Ring& part : simple_rings(plane, walk(plane, h, is_boundary))) {
      rings.push_back(std::move(part));
    }
  }
  HYPERMAP_ASSIGN_OR_RETURN(std::vector<Polygon> parts, assemble(rings, budget));
  if (parts.empty()) return fail(ErrorCode::kInvalidArgument, "the ring has no area");
  sort_by_place(parts);
  return WindingFill{std::move(parts), spike_free.had_spikes || has_lines(plane)};
}

Result<WindingFill> resolve_winding(Ring ring) {
  return resolve_winding(std::move(ring), LoadBudget());
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon_budget.hpp"
#include "ring_check.hpp"
#include "ring_sweep.hpp"
#include "touching_rings.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

Result<Ring> checked_ring(Ring ring, const std::string& name) {
  auto clean = cleaned_ring(std::move(ring));
  if (!clean) {
    Error error = std::move(clean).error();
    error.what = name + " " + error.what;
    return Unexpected(std::move(error));
  }
  return clean;
}

/// A ring as the area within, with its bounds, which decide most questions.
struct RingArea {
  Polygon area;
  Rect box;

  explicit RingArea(const Ring& ring) : area{ring, {}}, box(bounds(area)) {}
  [[nodiscard]] Result<bool> holds(const Eigen::Vector2d& point, const LoadBudget& budget) const {
    const bool may =
        (point.array() >= box.min.array()).all() && (point.array() <= box.max.array()).all();
    if (!may) return false;
    HYPERMAP_TRY(budget.draw_edge_tests(area.outer.size()));
    return contains(area, point);
  }
};

/// No two rings cross, so one point of a hole decides for all of it. Those that touch have each
/// other on the right side.
Result<void> check_holes(const Polygon& polygon,
                         const RingPairs& touching,
                         const LoadBudget& budget) {
  const RingArea outer(polygon.outer);
  const std::vector<RingArea> holes(polygon.holes.begin(), polygon.holes.end());
  for (std::size_t i = 0; i < holes.size(); ++i) {
    const Eigen::Vector2d& point = polygon.holes[i].front();
    HYPERMAP_TRY(budget.draw_edge_tests(holes.size()));
    HYPERMAP_ASSIGN_OR_RETURN(const bool is_within, outer.holds(point, budget));
    if (!is_within && !touching.contains({0, i + 1})) {
      return fail(ErrorCode::kInvalidArgument,
                  "hole " + std::to_string(i + 1) + " lies outside the outer ring");
    }
    for (std::size_t k = 0; k < holes.size(); ++k) {
      if (k == i || touching.contains(std::minmax(i + 1, k + 1))) continue;
      HYPERMAP_ASSIGN_OR_RETURN(const bool is_nested, holes[k].holds(point, budget));
      if (!is_nested) continue;
      return fail(ErrorCode::kInvalidArgument,
                  "hole " + std::to_string(i + 1) + " lies inside hole " + std::to_string(k + 1));
    }
  }
  return {};
}

Result<void> check_limits(const Ring& outer, const std::vector<Ring>& holes) {
  std::size_t count = outer.size();
  for (const Ring& hole : holes) count += hole.size();
  if (count > kMaxPolygonPoints) {
    return fail(ErrorCode::kLimit,
                "has " + std::to_string(count) + " points, the limit is " +
                    std::to_string(kMaxPolygonPoints));
  }
  return {};
}

void orient(Ring& ring, bool counter_clockwise) {
  if (is_counter_clockwise(ring) != counter_clockwise) std::reverse(ring.begin(), ring.end());
}

/// The pairs of rings that touch in common corners. Errors: they meet in another way.
Result<RingPairs> check_intersections(const std::vector<Ring>& rings, const LoadBudget& budget) {
  const auto place = first_intersection(rings);
  if (!place) return RingPairs{};
  const bool is_one = rings.size() == 1;
  if (!is_one) {
    HYPERMAP_ASSIGN_OR_RETURN(auto touching, touching_pairs(rings, budget));
    if (touching) return *std::move(touching);
  }
  return fail(
      ErrorCode::kInvalidArgument,
      std::string(is_one ? "the ring crosses or touches itself" : "the rings cross or touch") +
          " at or near " + point_text(*place));
}

}  // namespace

Result<Polygon> make_polygon(Ring outer, std::vector<Ring> holes, const LoadBudget& budget) {
  HYPERMAP_TRY(check_limits(outer, holes));
  std::vector<Ring> rings;
  HYPERMAP_ASSIGN_OR_RETURN(Ring first, checked_ring(std::move(outer), "ring 1"));
  rings.push_back(std::move(first));
  for (Ring& hole : holes) {
    const std::string name = "ring " + std::to_string(rings.size() + 1);
    HYPERMAP_ASSIGN_OR_RETURN(Ring next, checked_ring(std::move(hole), name));
    rings.push_back(std::move(next));
  }
  orient(rings.front(), true);
  for (std::size_t i = 1; i < rings.size(); ++i) orient(rings[i], false);
  HYPERMAP_ASSIGN_OR_RETURN(const RingPairs touching, check_intersections(rings, budget));
  if (signed_area_m2(rings.front()) <= 0.0) {
    return fail(ErrorCode::kInvalidArgument, "ring 1 has no area");
  }
  Polygon polygon{std::move(rings.front()), {}};
  polygon.holes.assign(std::make_move_iterator(rings.begin() + 1),
                       std::make_move_iterator(rings.end()));
  HYPERMAP_TRY(check_holes(polygon, touching, budget));
  return polygon;
}

Result<Polygon> make_polygon(Ring outer, std::vector<Ring> holes) {
  return make_polygon(std::move(outer), std::move(holes), LoadBudget());
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon.hpp"

#include "exact_orientation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Twice the signed area, and six times the first moment, about the ring's first point.
struct RingMoments {
  double area2 = 0.0;
  Eigen::Vector2d moment6 = Eigen::Vector2d::Zero();
};

RingMoments moments(const Ring& ring, const Eigen::Vector2d& about) {
  RingMoments sum;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d a = ring[i] - about;
    const Eigen::Vector2d b = ring[(i + 1) % ring.size()] - about;
    const double area2 = cross(a, b);
    sum.area2 += area2;
    sum.moment6 += area2 * (a + b);
  }
  return sum;
}

enum class Side { kInside, kEdge, kOutside };

Side side_of_ring(const Ring& ring, const Eigen::Vector2d& p) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    if (segments_intersect(a, b, p, p)) return Side::kEdge;
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    // The edge passes the height of p: count it when p lies to its left.
    if ((orientation(a, b, p) > 0) == (b.y() > a.y())) inside = !inside;
  }
  return inside ? Side::kInside : Side::kOutside;
}

Ring translated_ring(const Ring& ring, const Eigen::Vector2d& offset) {
  Ring out;
  out.reserve(ring.size());
  for (const Eigen::Vector2d& p : ring) out.emplace_back(p + offset);
  return out;
}

double distance_to_segment_m(const Eigen::Vector2d& a,
                             const Eigen::Vector2d& b,
                             const Eigen::Vector2d& p) {
  const Eigen::Vector2d edge = b - a;
  const double along = edge.dot(p - a) / std::max(edge.squaredNorm(), 1e-300);
  return (a + std::clamp(along, 0.0, 1.0) * edge - p).norm();
}

double distance_to_ring_m(const Ring& ring, const Eigen::Vector2d& p) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    least_m = std::min(least_m, distance_to_segment_m(ring[i], ring[(i + 1) % ring.size()], p));
  }
  return least_m;
}

double distance_to_edges_m(const Polygon& polygon, const Eigen::Vector2d& p) {
  double least_m = distance_to_ring_m(polygon.outer, p);
  for (const Ring& hole : polygon.holes) least_m = std::min(least_m, distance_to_ring_m(hole, p));
  return least_m;
}

/// From the corners of `a` to the edges of `b`.
double corners_to_edges_m(const Polygon& a, const Polygon& b) {
  double least_m = std::numeric_limits<double>::infinity();
  const auto visit = [&](const Ring& ring) {
    for (const Eigen::Vector2d& p : ring) least_m = std::min(least_m, distance_to_edges_m(b, p));
  };
  visit(a.outer);
  for (const Ring& hole : a.holes) visit(hole);
  return least_m;
}

/// Appends the lower hull of `points`, given in order, without its last point.
template <class Points>
void append_chain(const Points& points, Ring& hull) {
  const std::size_t first = hull.size();
  for (const Eigen::Vector2d& p : points) {
    while (hull.size() >= first + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) {
      hull.pop_back();
    }
    hull.push_back(p);
  }
  hull.pop_back();
}

}  // namespace

double area_m2(const Polygon& polygon) {
  if (polygon.outer.empty()) return 0.0;
  double area2 = moments(polygon.outer, polygon.outer.front()).area2;
  for (const Ring& hole : polygon.holes) area2 += moments(hole, polygon.outer.front()).area2;
  return 0.5 * std::abs(area2);
}

Eigen::Vector2d centroid(const Polygon& polygon) {
  assert(!polygon.outer.empty());
  const Eigen::Vector2d about = polygon.outer.front();
  RingMoments sum = moments(polygon.outer, about);
  for (const Ring& hole : polygon.holes) {
    const RingMoments part = moments(hole, about);
    sum.area2 += part.area2;
    sum.moment6 += part.moment6;
  }
  return about + sum.moment6 / (3.0 * sum.area2);
}

Rect bounds(const Polygon& polygon) {
  assert(!polygon.outer.empty());
  Rect rect{polygon.outer.front(), polygon.outer.front()};
  for (const Eigen::Vector2d& p : polygon.outer) {
    rect.min = rect.min.cwiseMin(p);
    rect.max = rect.max.cwiseMax(p);
  }
  return rect;
}

bool contains(const Polygon& polygon, const Eigen::Vector2d& point) {
  if (side_of_ring(polygon.outer, point) == Side::kOutside) return false;
  return std::none_of(polygon.holes.begin(), polygon.holes.end(), [&](const Ring& hole) {
    return side_of_ring(hole, point) == Side::kInside;
  });
}

double distance_m(const Polygon& polygon, const Eigen::Vector2d& point) {
  return contains(polygon, point) ? 0.0 : distance_to_edges_m(polygon, point);
}

double distance_m(const Polygon& a, const Polygon& b) {
  if (intersects(a, b)) return 0.0;
  // Of edges that do not cross, the nearest points are never inside both.
  return std::min(corners_to_edges_m(a, b), corners_to_edges_m(b, a));
}

Polygon translated(const Polygon& polygon, const Eigen::Vector2d& offset) {
  Polygon out{translated_ring(polygon.outer, offset), {}};
  for (const Ring& hole : polygon.holes) out.holes.push_back(translated_ring(hole, offset));
  return out;
}

Result<Polygon> convex_hull(std::span<const Eigen::Vector2d> points) {
  Ring sorted(points.begin(), points.end());
  std::sort(sorted.begin(), sorted.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  Ring hull;
  if (sorted.size() >= 3) {
    append_chain(sorted, hull);
    append_chain(Ring(sorted.rbegin(), sorted.rend()), hull);
  }
  if (hull.size() < 3) {
    return fail(ErrorCode::kInvalidArgument,
                std::to_string(points.size()) + " points span no area, expected 3 not on one line");
  }
  return Polygon{std::move(hull), {}};
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

namespace bg = boost::geometry;
using FlatPoint = bg::model::d2::point_xy<double>;
/// Counter-clockwise and open, as ours.
using FlatPolygon = bg::model::polygon<FlatPoint, false, false>;
using BoostMultiPolygon = bg::model::multi_polygon<FlatPolygon>;

void append(const Ring& ring, const Eigen::Vector2d& origin, FlatPolygon::ring_type& out) {
  for (const Eigen::Vector2d& p : ring) out.emplace_back(p.x() - origin.x(), p.y() - origin.y());
}

FlatPolygon to_boost(const Polygon& polygon, const Eigen::Vector2d& origin) {
  FlatPolygon out;
  append(polygon.outer, origin, out.outer());
  for (const Ring& hole : polygon.holes) append(hole, origin, out.inners().emplace_back());
  return out;
}

bool rectangles_intersect(const Rect& a, const Rect& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

std::optional<double> try_intersection_area(const FlatPolygon& a, const FlatPolygon& b) {
  try {
    BoostMultiPolygon common;
    bg::intersection(a, b, common);
    return bg::area(common);
  } catch (const bg::exception&) {
    return std::nullopt;
  }
}

double intersection_area_m2(const Polygon& a, const Polygon& b) {
  // Near the origin, where coordinates are exact enough for the overlay of Boost.
  const Eigen::Vector2d origin = a.outer.front();
  const FlatPolygon first = to_boost(a, origin);
  // The overlay gives up on rare degenerate contacts; shifted by a fraction of a micrometre they
  // are gone, and the area is the same for every purpose of a map.
  for (const double shift_m : {0.0, 1.3e-7, -2.1e-7}) {
    const Eigen::Vector2d shifted = origin + Eigen::Vector2d(shift_m, 0.7 * shift_m);
    if (const auto area = try_intersection_area(first, to_boost(b, shifted))) {
      return std::clamp(*area, 0.0, std::min(area_m2(a), area_m2(b)));
    }
  }
  return 0.0;
}

Ring to_ring(const FlatPolygon::ring_type& ring) {
  Ring out;
  out.reserve(ring.size());
  for (const FlatPoint& p : ring) out.emplace_back(p.x(), p.y());
  return out;
}

Polygon from_boost(const FlatPolygon& polygon) {
  Polygon out;
  out.outer = to_ring(polygon.outer());
  for (const FlatPolygon::ring_type& hole : polygon.inners()) out.holes.push_back(to_ring(hole));
  return out;
}

}  // namespace

bool intersects(const Polygon& a, const Polygon& b) {
  if (!rectangles_intersect(bounds(a), bounds(b))) return false;
  const Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  try {
    return bg::intersects(to_boost(a, origin), to_boost(b, origin));
  } catch (const bg::exception&) {
    return intersection_area_m2(a, b) > 0.0;
  }
}

double jaccard(const Polygon& a, const Polygon& b) {
  if (a.outer.empty() || b.outer.empty() || !rectangles_intersect(bounds(a), bounds(b))) return 0.0;
  const double common = intersection_area_m2(a, b);
  const double together = area_m2(a) + area_m2(b) - common;
  return together > 0.0 ? common / together : 0.0;
}

Result<std::vector<Polygon>> unite(std::span<const Polygon> polygons) {
  BoostMultiPolygon all;
  try {
    for (const Polygon& polygon : polygons) {
      BoostMultiPolygon merged;
      bg::union_(all, to_boost(polygon, Eigen::Vector2d::Zero()), merged);
      all = std::move(merged);
    }
  } catch (const bg::exception& error) {
    return fail(ErrorCode::kInvalidArgument, error.what());
  }
  std::vector<Polygon> pieces;
  pieces.reserve(all.size());
  for (const FlatPolygon& piece : all) pieces.push_back(from_boost(piece));
  return pieces;
}

Polygon simplified(const Polygon& polygon, double tolerance_m) {
  const Eigen::Vector2d origin = polygon.outer.front();
  FlatPolygon simple;
  bg::simplify(to_boost(polygon, origin), simple, tolerance_m);
  Polygon out = translated(from_boost(simple), origin);
  auto valid = make_polygon(std::move(out.outer), std::move(out.holes));
  return valid ? *std::move(valid) : polygon;
}

double covered_share(const Polygon& a, const Polygon& b) {
  if (b.outer.empty() || !rectangles_intersect(bounds(a), bounds(b))) return 0.0;
  return intersection_area_m2(a, b) / area_m2(a);
}

}  // namespace hypermap

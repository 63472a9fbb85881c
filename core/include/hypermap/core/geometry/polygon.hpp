// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Footprints and areas: plane polygons with holes.
///
/// Source: [hypermap] 3.3.3 (semantic layer), 3.4.1 (Jaccard index).
#pragma once

#include "hypermap/core/base/result.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace hypermap {

/// A ring of points. Open: the first point is not repeated at the end. Unit: metre.
using Ring = std::vector<Eigen::Vector2d>;

/// A plane polygon: one outer ring, counter-clockwise, and holes, clockwise, in the plane of a
/// frame that the owner names.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

/// Axis-aligned rectangle in the plane.
struct Rect {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();
  Eigen::Vector2d max = Eigen::Vector2d::Zero();
  friend bool operator==(const Rect&, const Rect&) = default;
};

/// Brings a ring sequence into the form above: drops repeated points, corrects closure and
/// orientation.
///
/// Errors: kInvalidArgument with the reason: fewer than three distinct points, zero area, a spike,
/// a ring that crosses or touches itself, or another one elsewhere than in corners of both, a hole
/// outside or inside another hole, a coordinate that is not finite or beyond 1e6 m; kLimit beyond
/// 10^5 points in all.
/// Boundary: orientation is decided exactly, so a crossing is never missed or invented by rounding.
/// Rings with more than 4,096 points in all may not touch.
/// Cost: O(n log n) for any input (a sweep that stops at the first crossing), and O(n h) for h
/// holes; O(n^2) for rings that touch.
[[nodiscard]] Result<Polygon> make_polygon(Ring outer, std::vector<Ring> holes = {});

/// A ring, and whether parts of it went straight back on themselves.
struct SpikeFreeRing {
  Ring ring;
  bool had_spikes = false;
};

/// The ring without its spikes (ways out and straight back again), which enclose nothing: its
/// winding numbers stay. Repeated points go too.
///
/// Errors: kInvalidArgument: a coordinate that is not finite or beyond 1e6 m; fewer than three
/// distinct points left. Cost: O(n log n).
[[nodiscard]] Result<SpikeFreeRing> without_spikes(Ring ring);

/// What a ring stands for whose winding numbers have one sign.
struct WindingFill {
  std::vector<Polygon> parts;  ///< In the order of their lowest, then leftmost point.
  bool had_spikes = false;     ///< Pieces of the ring that enclose nothing were dropped.
};

/// What a ring that is wound more than once, or that touches or crosses itself, stands for: the
/// area where its winding number is not zero, in one or several parts.
///
/// Faulty hull code writes such rings; all their winding numbers have one sign. A simple ring gives
/// itself. Spikes are dropped, also those that only the overlap of windings leaves. Crossings are
/// rounded to 1e-9 m.
/// Errors: kInvalidArgument with the reason: winding numbers of both signs (a bow-tie), fewer than
/// three distinct points, zero area, a coordinate that is not finite or beyond 1e6 m;
/// kLimit beyond 10^5 points, and when a ring that crosses itself has more than 4,096 points or
/// more than 100,000 crossings.
/// Cost: O(n log n) for simple rings, else O(n^2) within these limits.
[[nodiscard]] Result<WindingFill> resolve_winding(Ring ring);

[[nodiscard]] double area_m2(const Polygon& polygon);
/// Centroid of the area. Requires: a valid polygon.
[[nodiscard]] Eigen::Vector2d centroid(const Polygon& polygon);
[[nodiscard]] Rect bounds(const Polygon& polygon);
/// Closed: points on an edge are inside.
[[nodiscard]] bool contains(const Polygon& polygon, const Eigen::Vector2d& point);
/// Closed: polygons that touch intersect.
[[nodiscard]] bool intersects(const Polygon& a, const Polygon& b);
/// Area of the intersection over area of the union, in place. Source: [hypermap] 3.4.1.
[[nodiscard]] double jaccard(const Polygon& a, const Polygon& b);
/// Share of the area of `a` that `b` covers, in place. Requires: `a` has an area.
[[nodiscard]] double covered_share(const Polygon& a, const Polygon& b);
/// From a point to the nearest one of the polygon. Boundary: 0 inside and on an edge.
[[nodiscard]] double distance_m(const Polygon& polygon, const Eigen::Vector2d& point);
/// Between the nearest points of both. Boundary: 0 when they intersect.
/// Cost: the product of their corners.
[[nodiscard]] double distance_m(const Polygon& a, const Polygon& b);
/// The area that polygons cover together, in pieces that do not overlap.
///
/// Rings keep corners where edges went straight on. Exact where coordinates are whole numbers.
/// Errors: kInvalidArgument when the overlay of Boost gives up on a degenerate contact.
/// Boundary: no polygons, no pieces. Cost: O(k n log n) for k polygons, n points in all.
[[nodiscard]] Result<std::vector<Polygon>> unite(std::span<const Polygon> polygons);
[[nodiscard]] Polygon translated(const Polygon& polygon, const Eigen::Vector2d& offset);
/// With fewer corners: those left out lie within `tolerance_m` of the new outline (Douglas and
/// Peucker, 1973). Requires: a valid polygon; tolerance_m >= 0.
/// Boundary: the polygon itself where the new one would cross itself or have no area.
[[nodiscard]] Polygon simplified(const Polygon& polygon, double tolerance_m);
/// Convex hull. Errors: kInvalidArgument when fewer than three points span an area.
[[nodiscard]] Result<Polygon> convex_hull(std::span<const Eigen::Vector2d> points);

}  // namespace hypermap

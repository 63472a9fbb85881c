// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/ring.hpp>

#include <cmath>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr double kGridPerMetre = 1e4;  // 0.1 mm
constexpr double kMinGridArea = 1.0;
constexpr double kSimplifyGrid = 3.0;  // corners that bend by less than 0.3 mm are none

/// The convex outlines of the parts in grid units; upright sheets cover no area and have none.
std::vector<Polygon> outlines_of_parts(const TriangleMesh& mesh) {
  std::vector<Polygon> outlines;
  outlines.reserve(mesh.parts.size());
  for (const TriangleMesh::Part& part : mesh.parts) {
    std::vector<Eigen::Vector2d> points;
    points.reserve(part.count);
    for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
      const Eigen::Vector2d in_metres = mesh.vertices[i].head<2>().cast<double>();
      points.emplace_back((kGridPerMetre * in_metres).array().round());
    }
    Result<Polygon> outline = convex_hull(points);
    if (outline.has_value() && area_m2(*outline) > kMinGridArea)
      outlines.push_back(*std::move(outline));
  }
  return outlines;
}

/// Corners that bend too little are left out.
Ring simplified(const Ring& ring) {
  namespace bg = boost::geometry;
  using GridPoint = bg::model::d2::point_xy<double>;
  using ClosedRing = bg::model::ring<GridPoint, false, true>;
  ClosedRing closed;
  for (const Eigen::Vector2d& point : ring) closed.emplace_back(point.x(), point.y());
  if (!closed.empty()) closed.push_back(GridPoint(closed.front()));
  ClosedRing simple;
  bg::simplify(closed, simple, kSimplifyGrid);
  Ring out;
  out.reserve(simple.size());
  for (const GridPoint& point : simple) out.emplace_back(point.x(), point.y());
  return out;
}

/// The outline of what hangs together; of what does not, the convex hull of all.
Result<Ring> outline_of(const std::vector<Polygon>& pieces) {
  if (pieces.size() == 1) return simplified(pieces.front().outer);
  std::vector<Eigen::Vector2d> corners;
  for (const Polygon& piece : pieces)
    corners.insert(corners.end(), piece.outer.begin(), piece.outer.end());
  HYPERMAP_ASSIGN_OR_RETURN(Polygon hull, convex_hull(corners));
  return std::move(hull.outer);
}

}  // namespace

Result<Polygon> footprint(const TriangleMesh& mesh) {
  HYPERMAP_ASSIGN_OR_RETURN(const std::vector<Polygon> pieces, unite(outlines_of_parts(mesh)));
  if (pieces.empty()) return fail(ErrorCode::kInvalidArgument, "the shape covers no area");
  HYPERMAP_ASSIGN_OR_RETURN(Ring ring, outline_of(pieces));
  for (Eigen::Vector2d& point : ring) point /= kGridPerMetre;
  return make_polygon(std::move(ring));
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/simulator/triangle_mesh.hpp"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_polygon.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hypermap {
namespace {

namespace bg = boost::geometry;
using GridPoint = bg::model::d2::point_xy<double>;
using GridPolygon = bg::model::polygon<GridPoint, false, true>;
using GridPolygons = bg::model::multi_polygon<GridPolygon>;

constexpr double kGridPerMetre = 1e4;  // 0.1 mm
constexpr double kSimplifyGrid = 3.0;  // corners that bend by less than 0.3 mm are none

/// The convex outline of one part in grid units; empty when it covers no area (an upright sheet).
GridPolygon outline(const TriangleMesh& mesh, const TriangleMesh::Part& part) {
  bg::model::multi_point<GridPoint> points;
  for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
    points.emplace_back(std::round(kGridPerMetre * static_cast<double>(mesh.vertices[i].x())),
                        std::round(kGridPerMetre * static_cast<double>(mesh.vertices[i].y())));
  }
  GridPolygon hull;
  bg::convex_hull(points, hull);
  return bg::area(hull) > 1.0 ? hull : GridPolygon{};
}

GridPolygons union_of_parts(const TriangleMesh& mesh) {
  GridPolygons all;
  for (const TriangleMesh::Part& part : mesh.parts) {
    const GridPolygon piece = outline(mesh, part);
    if (piece.outer().empty()) continue;
    GridPolygons merged;
    bg::union_(all, piece, merged);
    all = std::move(merged);
  }
  return all;
}

GridPolygon one_piece(const GridPolygons& pieces) {
  GridPolygon outline;
  if (pieces.size() == 1) {
    bg::simplify(pieces.front(), outline, kSimplifyGrid);
  } else {
    bg::convex_hull(pieces, outline);
  }
  return outline;
}

}  // namespace

Result<Polygon> footprint(const TriangleMesh& mesh) {
  try {
    const GridPolygon outline = one_piece(union_of_parts(mesh));
    Ring ring;
    for (const GridPoint& point : outline.outer())
      ring.emplace_back(point.x() / kGridPerMetre, point.y() / kGridPerMetre);
    if (ring.empty()) return fail(ErrorCode::kInvalidArgument, "the shape covers no area");
    return make_polygon(std::move(ring));
  } catch (const bg::exception& error) {
    return fail(ErrorCode::kInvalidArgument, error.what());
  }
}

}  // namespace hypermap

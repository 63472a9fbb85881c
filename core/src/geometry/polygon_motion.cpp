// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/geometry/polygon_motion.hpp"

namespace hypermap {
namespace {

void move_corners(Ring& ring, const Eigen::Isometry2d& to_from) {
  for (Eigen::Vector2d& corner : ring) corner = to_from * corner;
}

}  // namespace

Polygon moved(Polygon polygon, const Eigen::Isometry2d& to_from) {
  move_corners(polygon.outer, to_from);
  for (Ring& hole : polygon.holes) move_corners(hole, to_from);
  return polygon;
}

}  // namespace hypermap

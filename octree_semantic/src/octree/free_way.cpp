// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/octree/free_way.hpp"

namespace hypermap {

bool is_way_free(const SemanticOctree& octree,
                 const Eigen::Vector3d& from_in_map,
                 const Eigen::Vector3d& to_in_map) {
  const double margin_m = octree.resolution_m();
  const Eigen::Vector3d way = to_in_map - from_in_map;
  const double length_m = way.norm() - 2.0 * margin_m;
  if (!(length_m > 0.0)) return true;
  const PointInMap start{from_in_map + margin_m * way.normalized()};
  const RayCast met = octree.cast_ray(start, way, {.max_range_m = length_m});
  return met.outcome != RayCast::Outcome::kHit;
}

}  // namespace hypermap

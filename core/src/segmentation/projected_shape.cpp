// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/projected_shape.hpp"

#include "hypermap/core/base/number_text.hpp"
#include "voxel_grid.hpp"

#include <cmath>

namespace hypermap {
namespace {

double on_millimetres(float coordinate_m) {
  return std::round(static_cast<double>(coordinate_m) * 1e3) / 1e3;
}

}  // namespace

Result<Polygon> projected_hull(std::span<const Eigen::Vector3f> points_in_map, double leaf_size_m) {
  if (!(leaf_size_m >= 0.0)) {
    return fail(
        ErrorCode::kInvalidArgument, "must be >= 0, is " + number_text(leaf_size_m), "leaf_size_m");
  }
  std::vector<Eigen::Vector3f> on_floor(points_in_map.begin(), points_in_map.end());
  for (Eigen::Vector3f& point : on_floor) point.z() = 0.0F;
  std::vector<Eigen::Vector2d> thinned;
  for (const Eigen::Vector3f& centroid : voxel_grid(on_floor, leaf_size_m).centroids) {
    thinned.emplace_back(on_millimetres(centroid.x()), on_millimetres(centroid.y()));
  }
  return convex_hull(thinned);
}

}  // namespace hypermap

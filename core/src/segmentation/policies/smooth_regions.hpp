// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Surfaces without edges.
#pragma once

#include "hypermap/core/geometry/camera.hpp"
#include "segmentation/point_clusters.hpp"
#include "segmentation_policies.hpp"

#include <vector>

namespace hypermap {

/// Smooth regions of at least `region_min_points`, largest first, of equals the one with the first
/// point.
///
/// A region starts at the flattest point that is in none and goes on to those of the nearest points
/// of each of its points whose normals agree with that one's. Normals are fitted by PCL; regions
/// are those of its RegionGrowing.
/// Source: [hypermap] 2.4.1, 3.4.4. Boundary: none of fewer than three points. Cost: linear in the
/// points on surfaces (`ImageNeighbours`); 4 B for each of
/// the nearest points of each point.
[[nodiscard]] std::vector<PointIndices> smooth_regions(const PixelCloud& cloud,
                                                       const PinholeCamera& camera,
                                                       const RegionGrowingOptions& options);

}  // namespace hypermap

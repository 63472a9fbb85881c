// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The shape that one look at an object leaves on the floor plan.
///
/// Source: [hypermap] 3.4.4.
#pragma once

#include "hypermap/core/geometry/polygon.hpp"
#include "hypermap/core/segmentation/segment.hpp"

#include <span>

namespace hypermap {

/// Projects the points to the map's x-y plane, thins them by a plane grid of `leaf_size_m` (one
/// mean per cell; 0 keeps all) and takes the convex hull. Vertices lie on whole millimetres: depth
/// is no better known, and short numbers make small files.
///
/// Errors: kInvalidArgument when the points span no area, or leaf_size_m < 0.
/// Cost: O(n log n).
[[nodiscard]] Result<Polygon> projected_hull(std::span<const Eigen::Vector3f> points_in_map,
                                             double leaf_size_m);

}  // namespace hypermap

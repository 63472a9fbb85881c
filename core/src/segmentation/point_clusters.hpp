// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The steps that PCL does, behind an interface without PCL's types.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// Positions in a point list, ascending.
using PointIndices = std::vector<std::uint32_t>;

/// The points whose mean distance to `neighbours` neighbours is at most the mean of that over all
/// points plus `stddev` standard deviations.
///
/// Source: [smap] pseudocode 3.1. Deviation: the text estimates a deviation per neighbourhood; this
/// is PCL's filter, which the text names, with one deviation over the whole cloud.
/// Boundary: fewer points than neighbours are all kept.
[[nodiscard]] PointIndices statistical_inliers(std::span<const Eigen::Vector3f> points,
                                               int neighbours,
                                               double stddev);

/// Groups of points linked by steps of at most `gap_m`, largest first, of equals the one with the
/// first point. Groups outside [min_points, max_points] are left out. Source: [smap] 3.3.
[[nodiscard]] std::vector<PointIndices> euclidean_clusters(std::span<const Eigen::Vector3f> points,
                                                           double gap_m,
                                                           int min_points,
                                                           int max_points);

}  // namespace hypermap

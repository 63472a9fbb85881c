// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From the labelled points of a scan to observations of objects.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/segmentation/labelled_cloud.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

struct CloudObservationOptions {
  double max_range_m = 100.0;  ///< Farther points show nothing. Unit: metre. > 0
  double leaf_size_m = 0.03;   ///< Points are thinned to one per cube; 0 keeps all.
  double depth_slack_m = 0.2;  ///< Depth extent without penalty of the box confidence.
};

/// Points of one class vector that belong to no instance.
struct ClassPoints {
  std::uint32_t class_vector = 0;            ///< Position in LabelledCloud::class_vectors.
  std::vector<std::uint32_t> point_indices;  ///< Ascending.
};

struct CloudObservations {
  /// One for each instance, in ascending order of their numbers. Class vector: the mean of those of
  /// its points; `segment.pixel_indices` are positions of points. Instances that have no finite
  /// point within the range are left out.
  std::vector<Observation> instances;
  std::vector<ClassPoints> classes;  ///< In ascending order of class vectors; none is empty.
};

/// What the points of a scan show. Requires: validate(cloud). Cost: O(n log n).
[[nodiscard]] CloudObservations observe_cloud(const LabelledCloud& cloud,
                                              const CloudObservationOptions& options = {});

}  // namespace hypermap

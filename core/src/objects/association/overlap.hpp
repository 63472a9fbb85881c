// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Overlap of the point sets of observations and objects, and whether two are one object.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "proximity_grid.hpp"

#include <vector>

namespace hypermap {

/// Box, points and classes of an observation or an object, ready to be compared.
struct PointSet {
  Box box;
  std::vector<ProximityCell> cells;    ///< Of its points, thinned evenly to at most 300.
  std::vector<ClassEvidence> classes;  ///< Ascending by id.
  ProximityGrid grid;                  ///< Of all points.
  std::uint32_t num_observations = 1;
};

/// `near_m`: points so near are near each other, those beyond twice that never. Requires: > 0.
/// Cost: O(points), no list of them is made.
[[nodiscard]] PointSet point_set_of(const Observation& observation, double near_m);
[[nodiscard]] PointSet point_set_of(const Object& object, double near_m);

struct Overlap {
  double share_of_first = 0.0;   ///< Of its points, those near the second.
  double share_of_second = 0.0;  ///< Of its points, those near the first.
  double box_share = 0.0;        ///< Of the smaller box, what lies in the other.
  double distance = 0.0;         ///< Of the centres in mean diagonals.
  double diagonal_ratio =
      0.0;  ///< The diagonal of the point set with the larger share over the other's.
  /// The diagonal of the box around both over the longer of theirs, >= 1; 1 when one box holds
  /// the other.
  double growth = 1.0;
  double agreement = 0.0;  ///< Of the class vectors, in [0, 1].
  /// Observations of the point set with the larger share over those of the other.
  double maturity_ratio = 1.0;
};

/// Requires: both were made with this `near_m`.
[[nodiscard]] Overlap measure_overlap(const PointSet& first, const PointSet& second, double near_m);

/// The largest common probability of one class, each relative to its best class, in [0, 1]: 1 when
/// the best classes are the same. Requires: ascending by id.
[[nodiscard]] double class_agreement(std::span<const ClassEvidence> a,
                                     std::span<const ClassEvidence> b);

/// The overlap suffices for one object; `strictness` >= 1 scales the thresholds.
[[nodiscard]] bool is_same_object(const Overlap& overlap,
                                  const AssignmentOptions& options,
                                  double strictness = 1.0);

/// Affinity of the two, > 0; only for ranking. The box around both speaks against them where it is
/// larger than either: parts of a chair touch the chair behind it as much as their own.
[[nodiscard]] double affinity(const Overlap& overlap);

}  // namespace hypermap

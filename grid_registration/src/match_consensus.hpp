// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Which shift, turn and scale most matches agree on.
#pragma once

#include "feature_matching.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace hypermap {

/// A placement, and the matches that lie together in it: of each feature the nearest.
struct Consensus {
  Eigen::Matrix3d fixed_from_moving = Eigen::Matrix3d::Identity();
  std::size_t num_inliers = 0;
  double rms = 0.0;  ///< Of their distances.
};

/// Whether a placement is to be considered.
using PlacementFilter = std::function<bool(const Eigen::Matrix3d& fixed_from_moving)>;

struct ConsensusOptions {
  bool has_scale = false;     ///< From 0.5 to 2; else 1.
  double inlier_cells = 2.0;  ///< How near the places of a match lie to each other. Unit: cell.
  PlacementFilter is_allowed = {};
};

/// The best few, of most inliers first, no two of which put the middle of the matches' places, or
/// what is `span_cells` away from there, within twice `inlier_cells` of each other. Pairs of
/// matches propose them, drawn by seeded numbers: same input, same result.
[[nodiscard]] std::vector<Consensus> best_consensuses(std::span<const FeatureMatch> matches,
                                                      double span_cells,
                                                      const ConsensusOptions& options);

/// What agrees with a placement.
[[nodiscard]] Consensus consensus_of(const Eigen::Matrix3d& fixed_from_moving,
                                     std::span<const FeatureMatch> matches,
                                     double inlier_cells);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From where an object was detected.
#pragma once

#include "hypermap/core/objects/observation_log.hpp"

#include <Eigen/Core>

#include <vector>

namespace hypermap {

/// Unit vectors from the object to the cameras that detected it: the middles of the bearing bins
/// with a detection, ascending.
[[nodiscard]] std::vector<Eigen::Vector2d> seen_directions(const ObservationLog& log);

/// Whether one of them lies within 60 degrees of the outward unit vector `normal`.
[[nodiscard]] bool is_faced(const Eigen::Vector2d& normal,
                            const std::vector<Eigen::Vector2d>& directions);

}  // namespace hypermap

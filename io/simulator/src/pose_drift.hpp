// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How the poses that a robot records go astray from where it was.
#pragma once

#include "hypermap/core/geometry/frames.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// The recorded poses of a true way: a random walk of position (in the plane) and heading, whose
/// standard deviation after one metre is `scale` times 1 cm in x and y and 0.1 degrees; it grows
/// with the root of the way, turning in place counts 0.3 m a radian. `scale` 0 gives the true
/// poses.
[[nodiscard]] std::vector<MapFromCamera> drifted(std::span<const MapFromCamera> true_poses,
                                                 double scale,
                                                 std::uint64_t seed);

/// The pose with white noise: each coordinate of the position moved by a normal of `stddev_m`, the
/// orientation turned by a rotation vector of normals of `stddev_rad`. Both 0 give the pose itself.
/// `frame` names the random numbers, so that a frame's noise does not depend on other frames.
[[nodiscard]] MapFromCamera with_white_noise(const MapFromCamera& pose,
                                             double stddev_m,
                                             double stddev_rad,
                                             std::uint64_t seed,
                                             std::uint64_t frame);

}  // namespace hypermap

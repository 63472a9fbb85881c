// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The floor around a detection, of which furniture leaves little to be seen.
#pragma once

#include "plane_points.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace hypermap {

/// The level plane that holds most of the points that no plane has yet, when that is `least` or
/// more of them and nothing lies below it: between tables and chairs a floor is much less than
/// other planes have to be, and seen through a chair it is no part of it. `all` are the points
/// around the detection, `left` those without a plane.
///
/// Frame: Camera. Requires: least > 0.
/// Boundary: no plane when another one is the floor, or nobody sees it. Of points below, a quarter
/// of `least` may be the sensor's errors.
/// Cost: O(least * points).
[[nodiscard]] std::optional<Plane> floor_around(const PlanePoints& all,
                                                const PlanePoints& left,
                                                const Eigen::Vector3f& up_in_camera,
                                                std::size_t least,
                                                const ForegroundOptions& options);

}  // namespace hypermap

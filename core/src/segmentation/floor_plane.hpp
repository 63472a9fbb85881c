// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The floor around a detection, of which furniture leaves little to be seen.
#pragma once

#include "background_planes.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "plane_points.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>

namespace hypermap {

/// The lowest level plane among the points that no plane has yet: through one of the 2 * `least`
/// lowest of them, with `least` or more on it and hardly a point around the detection below it; of
/// several the one that holds most, of equals the lowest. Between tables and chairs a floor is less
/// than other planes have to be, and what is seen of it through a chair is no part of that. `all`
/// are the points around the detection, `left` those without a plane.
///
/// Frame: Camera. Requires: least > 0.
/// Boundary: none when another plane is the floor, or nobody sees it; points below, up to a quarter
/// of `least`, may be the sensor's errors. It is as level as the map: where that leans by 2
/// degrees, it holds about half of a floor that is 1.5 m long.
/// Cost: O(least * points).
[[nodiscard]] std::optional<Plane> floor_around(const PlanePoints& all,
                                                const PlanePoints& left,
                                                const Eigen::Vector3f& up_in_camera,
                                                std::size_t least,
                                                const ForegroundOptions& options);

}  // namespace hypermap

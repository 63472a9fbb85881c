// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The top of an object that is seen too flat for a depth sensor to measure.
#pragma once

#include "segmentation/depth_window.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace hypermap {

/// Points on the level top of an object whose upper edge is measured and whose top is not: a table
/// three metres away gives its edge and its legs, the light that meets its top is reflected away
/// from the sensor.
///
/// A gap in the depth above a level edge of the object shows its top where rays meet the plane of
/// the edge flatter than sensors measure (70 degrees from its normal). It begins behind the edge:
/// what lies nearer is the top of something else, which may be as high. And it is of the columns in
/// which the edge is seen, or something nearer than the edge in the nearest of these: what else
/// stands beside the object has a top of its own. Any level surface
/// behind the object is seen as flat, so the gap ends with the mask where there is one, else where
/// something is measured again, or a tenth of the box's height below the box's upper border when
/// nothing is, for there a detector's inaccuracy is all that ends it. All of it is refused when
/// more than a tenth lies farther than 1.25 lengths of the edge from its middle.
///
/// `is_object` is 1 on the cells of the object. Frame: camera; unit: metre; no farther apart than
/// `spacing_m` along the line of sight. Empty when there is no such gap, for things lower than 0.3
/// m and seats with backs, when the camera is rolled by more than 30 degrees and when
/// the edge is above the camera. Cost: O(cells of the box). Not in the sources.
[[nodiscard]] std::vector<Eigen::Vector3f> unmeasured_top(
    const DepthWindow& window,
    const std::vector<std::uint8_t>& is_object,
    const Eigen::Matrix3f& gravity_aligned_from_camera,
    float spacing_m);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Depth of one camera as another camera beside it would see it.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/camera.hpp"

#include <Eigen/Geometry>

namespace hypermap {

/// Every depth pixel is carried over as the patch that it covers; where patches meet the nearest
/// stays. Pixels that no patch reaches have no measurement (0).
///
/// Cost: O(pixels of both images).
[[nodiscard]] DepthImage register_depth(const DepthImage& depth_m,
                                        const PinholeCamera& depth_camera,
                                        const PinholeCamera& color_camera,
                                        const Eigen::Isometry3d& color_from_depth);

}  // namespace hypermap

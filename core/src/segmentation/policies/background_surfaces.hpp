// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a window shows that is not the detection's object.
#pragma once

#include "hypermap/core/segmentation/background_cells.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"
#include "segmentation/depth_components.hpp"
#include "segmentation/depth_window.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// The cells of surfaces that run on beyond the box: more of them than `part_max_outside` lies
/// outside. A plane that is cut off from its part outside does not run on: the seats of two chairs
/// are of one height. With a mask all that is measured and no part of it, as far as its edge may be
/// off.
///
/// `surfaces`: of the window, before planes grow: the foot of a screen is its own. `is_object` is 1
/// on the cells of the object; they are left out. Cost: O(cells). Not in the sources.
[[nodiscard]] BackgroundCells background_surfaces(const DepthWindow& window,
                                                  const DepthComponents& surfaces,
                                                  const std::vector<std::uint8_t>& is_object,
                                                  const ForegroundOptions& options);

}  // namespace hypermap

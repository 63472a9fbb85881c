// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Level faces among the surfaces of a window: seats, tops of tables.
#pragma once

#include "segmentation/depth_components.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace hypermap {

/// Whether two surfaces are level faces of different heights, and so of two things: the seat of a
/// chair under the top of a table.
///
/// Their normals point up, within 26 degrees, and more than 10 cm of height lie between them. The
/// rail of a back is no level face, however narrow: it spreads least across its face. Requires:
/// both have cells in the box. Cost: O(cells of the bounds of `id`, and of `best` where that is
/// level). Not in the sources.
[[nodiscard]] bool are_two_levels(const DepthWindow& window,
                                  const DepthComponents& labelled,
                                  std::uint32_t best,
                                  std::uint32_t id,
                                  const Eigen::Matrix3f& gravity_aligned_from_camera);

}  // namespace hypermap

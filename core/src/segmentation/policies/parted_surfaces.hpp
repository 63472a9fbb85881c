// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Parts of an object between which something nearer stands in the picture.
#pragma once

#include "segmentation/depth_components.hpp"

#include <Eigen/Core>

#include <cstdint>

namespace hypermap {

/// Whether surfaces `best` and `id` may be the two ends of one face: those of a microwave behind a
/// vase.
///
/// Of the rows of the picture that both have, in most, and in half of those of the lower one, what
/// is measured between them is clearly nearer than either and at least half of the cells there. The
/// ends are no farther apart than the wider one is wide and half a metre, and in depth than half of
/// that: so far a face may be turned from the camera. Not in the sources. Requires: both have cells
/// in the box. Cost: O(cells of the box).
[[nodiscard]] bool are_ends_of_one_face(const DepthWindow& window,
                                        const DepthComponents& labelled,
                                        std::uint32_t best,
                                        std::uint32_t id);

/// Whether surfaces `best` and `id` may be one upright face, one over the other: the door of a
/// refrigerator and its foot below the desk before it.
///
/// Of the columns of the picture that both have, in most, and in half of those of the narrower one,
/// something clearly nearer and nothing else is measured between them, and both ends of `id` are as
/// far away on the floor plan as that end of `best`. Not in the sources. Boundary: a camera that is
/// rolled sees slanting columns, and the faces of what it does not look at squarely are not found.
/// Requires: both have cells in the box. `gravity_aligned_from_camera` turns the camera's axes so
/// that z is up. Cost: O(cells of the box).
[[nodiscard]] bool are_one_upright_face(const DepthWindow& window,
                                        const DepthComponents& labelled,
                                        std::uint32_t best,
                                        std::uint32_t id,
                                        const Eigen::Matrix3f& gravity_aligned_from_camera);

}  // namespace hypermap

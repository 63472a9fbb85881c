// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a frame shows of classes that do not stay.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <span>

namespace hypermap {

/// The frame without a measurement where the observations are and as far beside them as the edge of
/// a mask may be off; its colour is borrowed, its detections are left out.
/// Requires: the observations are of this frame. Cost: O(pixels).
[[nodiscard]] RgbdFrame without_observations(const RgbdFrame& frame,
                                             std::span<const Observation> observations);

}  // namespace hypermap

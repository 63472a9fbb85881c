// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a frame shows of classes that do not stay.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <cstddef>
#include <span>

namespace hypermap {

/// 1 on the pixels that the detections may show: of their masks and as far as these may be off,
/// else of their boxes. Empty without detections. Cost: O(pixels) a detection.
[[nodiscard]] MaskImage pixels_shown_by(const PinholeCamera& camera,
                                        std::span<const Detection* const> detections);

struct StillFrame {
  RgbdFrame frame;
  std::size_t num_left_out = 0;  ///< Its pixels of depth 0 that had another depth.
};

/// The frame without a measurement where the observations are, and as far beside them as the edge
/// of a mask may be off, and where the detections may be that have no segment: out of the range of
/// segmentation, or too small. Its colour is borrowed, its detections are left out.
/// Requires: the observations are of this frame. Cost: O(pixels).
[[nodiscard]] StillFrame without_transient(const RgbdFrame& frame,
                                           std::span<const Observation> observations,
                                           std::span<const Detection* const> without_segment);

}  // namespace hypermap

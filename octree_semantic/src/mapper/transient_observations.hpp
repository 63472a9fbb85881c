// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a frame shows of classes that do not stay.
#pragma once

#include "hypermap/core/objects/association.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

/// 1 on the pixels that the detections may show: of their masks and as far as these may be off,
/// else of their boxes. Empty without detections. Cost: O(pixels) a detection.
[[nodiscard]] MaskImage pixels_shown_by(const PinholeCamera& camera,
                                        std::span<const Detection* const> detections);

/// The detections of a frame that are of classes that do not stay.
struct TransientDetections {
  std::vector<Observation> observations;          ///< Those that the depth confirms.
  std::vector<const Detection*> without_segment;  ///< Those that it does not confirm.
  std::vector<const Detection*> not_begun;        ///< Those that nobody had time for.
  [[nodiscard]] bool empty() const {
    return observations.empty() && without_segment.empty() && not_begun.empty();
  }
};

/// The depths in which segments are looked for, along the camera's axis.
struct SegmentedDepth {
  double min_m = 0.0;
  double max_m = 0.0;
  [[nodiscard]] bool contains(double depth_m) const { return depth_m >= min_m && depth_m <= max_m; }
};

struct StillFrame {
  RgbdFrame frame;
  std::size_t num_left_out = 0;  ///< Measurements of the frame that are none here.
};

/// The frame without a measurement where the observations are, and as far beside them as the edge
/// of a mask may be off, and where those may be that were not begun. Of those without a segment,
/// out of `segmented` alone: in it the depth was looked at and showed nothing of theirs. Its colour
/// is borrowed, its detections are left out.
/// Requires: the observations are of this frame.
/// Cost: O(pixels), and that again a detection without an observation.
[[nodiscard]] StillFrame without_transient(const RgbdFrame& frame,
                                           const TransientDetections& transient,
                                           const SegmentedDepth& segmented);

}  // namespace hypermap

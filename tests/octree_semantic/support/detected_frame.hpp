// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames with detections for tests of the whole mapper.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <algorithm>
#include <vector>

namespace hypermap::test {

/// The tight boxes of the labelled pixels of `room_frames`, those of few pixels left out; the
/// scores fall from box to box.
inline std::vector<RgbdFrame> detected_room_frames(int num_frames, int width_px) {
  std::vector<RgbdFrame> frames;
  for (LabelledFrame& labelled : room_frames(num_frames, width_px)) {
    RgbdFrame& frame = labelled.frame;
    for (const PixelLabels& label : labelled.labels) {
      if (label.pixel_indices.size() < 80) continue;
      PixelBox box{1e9, 1e9, 0, 0};
      for (const std::uint32_t pixel : label.pixel_indices) {
        const std::uint32_t row = pixel / static_cast<std::uint32_t>(width_px);
        const double u = pixel % static_cast<std::uint32_t>(width_px);
        const double v = row;
        box = {std::min(box.u_min_px, u),
               std::min(box.v_min_px, v),
               std::max(box.u_max_px, u + 1.0),
               std::max(box.v_max_px, v + 1.0)};
      }
      const double score = 0.9 - 0.05 * static_cast<double>(frame.detections.size());
      frame.detections.push_back({.box_px = box,
                                  .class_scores = label.class_scores,
                                  .score = Probability(score),
                                  .detector = {},
                                  .mask = {}});
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace hypermap::test

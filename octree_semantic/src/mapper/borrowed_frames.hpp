// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames that differ from a given one in one thing and borrow the rest.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <utility>

namespace hypermap {

/// The same pixels, which must outlive the result.
template <class Pixel>
[[nodiscard]] Image<Pixel> borrowed(const Image<Pixel>& image) {
  return Image<Pixel>::borrowed(image.width_px(), image.height_px(), image.pixels().data());
}

/// The frame with other depth of the same size, its colour borrowed and without its detections.
[[nodiscard]] inline RgbdFrame with_depth(const RgbdFrame& frame, DepthImage depth_m) {
  return {.index = frame.index,
          .name = frame.name,
          .stamp = frame.stamp,
          .camera = frame.camera,
          .map_from_camera = frame.map_from_camera,
          .depth_m = std::move(depth_m),
          .color = borrowed(frame.color),
          .detections = {},
          .floor_height_m = frame.floor_height_m};
}

/// The frame at another pose, with borrowed images and without its detections.
[[nodiscard]] inline RgbdFrame at_pose(const RgbdFrame& frame,
                                       const MapFromCamera& map_from_camera) {
  RgbdFrame moved = with_depth(frame, borrowed(frame.depth_m));
  moved.map_from_camera = map_from_camera;
  return moved;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// One moment of a posed RGB-D sequence.
#pragma once

#include "hypermap/core/base/ids.hpp"
#include "hypermap/core/base/image.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hypermap {

/// Depth, colour, pose and detections that belong together.
///
/// Depth is registered to colour: both have the camera's size (colour may be empty).
struct RgbdFrame {
  std::uint64_t index = 0;  ///< Position in the sequence, skipped frames counted.
  std::string name;         ///< How the dataset calls it, for messages.
  Stamp stamp;
  PinholeCamera camera;
  MapFromCamera map_from_camera;
  DepthImage depth_m;
  ColorImage color;
  std::vector<Detection> detections;
};

/// Errors: kInvalidArgument naming what disagrees: a picture's size with the camera, or a pose that
/// is no finite rigid motion (rotation off by more than 1e-3).
[[nodiscard]] Result<void> validate(const RgbdFrame& frame);

}  // namespace hypermap

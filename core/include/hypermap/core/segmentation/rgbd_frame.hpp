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
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

/// Depth, colour, pose and detections that belong together.
///
/// Depth is registered to colour: both have the camera's size (colour may be empty).
struct RgbdFrame {
  /// Position in the sequence, skipped frames counted; at most 2^63 - 1.
  std::uint64_t index = 0;
  std::string name;  ///< How the dataset calls it, for messages.
  Stamp stamp;
  PinholeCamera camera;
  MapFromCamera map_from_camera;
  DepthImage depth_m;  ///< From a driver's buffer: `depth_image`, depth_view.hpp.
  ColorImage color;
  std::vector<Detection> detections;
  /// Of the floor around the sensor where it is known, within 8 cm: policy kForeground takes what
  /// lies on it for background, however little of it is seen beside a detection. Frame: Map.
  std::optional<double> floor_height_m = {};
};

/// Whether a frame can be mapped and what is learnt from it be saved: judged here, at the door.
///
/// Errors: kInvalidArgument naming the field: `index` beyond its range; an image's size that is
/// not the camera's; a height of the floor that is not finite; a pose that is no finite rigid
/// motion (rotation off by more than 1e-3); of a detection (`detections[i]...`) a box that is not
/// finite or inside out, a score outside [0, 1], class scores that are none, outside [0, 1], not
/// ascending by id below 65,535 or whose sum is off 1 by more than 1e-3; kInvalidArgument and
/// kLimit of its embeddings. Boundary: any stamp is one; what is NaN in the depth is no
/// measurement.
[[nodiscard]] Result<void> validate(const RgbdFrame& frame);

}  // namespace hypermap

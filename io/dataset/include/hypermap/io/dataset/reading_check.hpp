// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Whether depth and poses of a dataset are taken as they are meant: scale of the depth, direction
/// and camera axes of the poses, up axis. Wrong ones read without an error and map as noise.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

/// How depth and poses are taken; fields of a description.
struct FrameReading {
  PoseDirection pose_direction = PoseDirection::kCameraToWorld;
  CameraAxes camera_axes = CameraAxes::kOptical;
  double depth_units_per_m = 1000.0;  ///< The description's `depth_scale`. > 0
  friend bool operator==(const FrameReading&, const FrameReading&) = default;
};

/// Two frames of one place, between which the camera moved.
struct FramePair {
  RgbdFrame first;
  RgbdFrame second;
};

/// A reading, and how well the frames bear it out.
struct ReadingAgreement {
  FrameReading reading;
  /// Of the first frames' points, those that the second frames measured at the same distance within
  /// 2 %; the mean over the pairs. 0 .. 1
  double share = 0.0;
};

struct ReadingCheck {
  std::size_t num_pairs = 0;  ///< That have enough depth to tell.
  ReadingAgreement taken;
  /// Another one that explains the frames much better; none where there is none, or too few pairs.
  std::optional<ReadingAgreement> better;
};

/// Compares how the frames were read with other readings: each of the other directions and axes,
/// and depth that is 5, 10 or 1000 times as large or as small, or an eighth (rotated bits). Another
/// one is better when most pairs say so, at least half of the points agree under it, and a fifth of
/// all more than do now.
///
/// Boundary: a camera that stands still bears out every reading, so none is better.
/// Frame: poses are `frame::Input`, read as `taken` says. Requires: taken.depth_units_per_m > 0.
/// Cost: some 800 points a pair and reading; no allocation that grows with the images.
[[nodiscard]] ReadingCheck check_reading(std::span<const FramePair> pairs,
                                         const FrameReading& taken);

/// A handful of pairs, spread over the sequence. The second frame is the next one, or up to 27
/// frames later where the camera has turned less than 5 degrees by then. Frames that cannot be read
/// are passed over. Cost: reads at most 30 frames.
/// Requires: `dataset` is not turned yet (map_from_input identity).
[[nodiscard]] std::vector<FramePair> moving_pairs(const DatasetReader& dataset);

/// What `check_reading` finds, in words: the fields of a description that explain the frames
/// better.
[[nodiscard]] std::optional<Finding> find_misreading(std::span<const FramePair> pairs,
                                                     const FrameReading& taken);

/// A finding when the frames agree where the camera's up is, the map's +z is more than 50 degrees
/// off, and another axis of the input is within 45 degrees, the opposite one or one about which the
/// camera turned more: that axis is named.
/// Boundary: a camera that turns less than 15 degrees tells nothing, it may look straight up.
[[nodiscard]] std::optional<Finding> find_wrong_up(std::span<const FramePair> pairs,
                                                   const MapFromInput& map_from_input);

/// How the dataset was read, by its summary.
[[nodiscard]] FrameReading reading_of(const DatasetSummary& summary);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Aligns a dataset's world to gravity: by a given axis, or by the floor that its images show.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/frames.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace hypermap {

struct OptionTable;

/// The smallest turn that brings `axis` of the input ("x", "-x", "y", "-y", "z", "-z") to +z of the
/// map; nothing is moved. Boundary: "-z" turns about x.
/// Errors: kInvalidArgument for another name.
[[nodiscard]] Result<MapFromInput> map_from_input_axis(std::string_view axis);

struct FloorOptions {
  std::size_t num_frames = 24;  ///< Spread evenly over the sequence. Range: 1 .. 1000
  int pixel_step = 6;           ///< Every n-th pixel each way. Range: 1 .. 64
  double min_range_m = 0.4;     ///< Nearer depth is not used. Range: > 0
  double max_range_m = 4.5;     ///< Farther depth is too noisy. Range: > min_range_m
  /// Of the floor's normal from the cameras' mean up (55 degrees). Range: 0 .. pi/2
  double max_tilt_rad = 0.96;
  double thickness_m = 0.04;  ///< Points this near to a plane lie on it. Range: 0.005 .. 0.5
  /// The floor is the lowest plane with this share of the level points. Range: 0 .. 1
  double min_level_share = 0.04;
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const FloorOptions& options);
[[nodiscard]] const OptionTable& option_table(const FloorOptions& options);

/// One point of a surface. Frame: Input.
struct SurfacePoint {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;  ///< Unit length, toward the camera that saw it.
};

/// What was found, and how well it is supported.
struct FloorEstimate {
  MapFromInput map_from_input;  ///< Floor at z = 0, turned as little as possible.
  Eigen::Vector3d up_in_input = Eigen::Vector3d::UnitZ();
  double floor_height_m = 0.0;        ///< Along `up_in_input`.
  double tilt_from_camera_rad = 0.0;  ///< From the cameras' mean up direction.
  double inlier_share = 0.0;          ///< Of all points, those on the floor.
  std::size_t num_points = 0;
};

/// One line for messages: normal, height, share.
[[nodiscard]] std::string to_string(const FloorEstimate& estimate);

/// Finds the floor in points of surfaces: the direction that most normals near `camera_up_in_input`
/// share, then the lowest plane across it that holds enough points. The same points give the same
/// answer, whatever happens elsewhere.
///
/// Errors: those of validate(options); kNotFound when fewer than 200 points are level, or no plane
/// holds enough of them.
/// Cost: O(points * 512).
[[nodiscard]] Result<FloorEstimate> find_floor(std::span<const SurfacePoint> points,
                                               const Eigen::Vector3d& camera_up_in_input,
                                               const FloorOptions& options = {});

/// Reads some frames and finds the floor in them; frames that cannot be read are passed over.
/// `reader` must not be turned yet (map_from_input identity).
/// Errors: those of `find_floor`; kNotFound when no frame can be read.
[[nodiscard]] Result<FloorEstimate> estimate_floor(const DatasetReader& reader,
                                                   const FloorOptions& options = {});

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How a camera sees: intrinsics in the forms that datasets come with.
///
/// Forms, found by content: our JSON, Open3D JSON, ROS `camera_info` YAML, a 3x3 (or ScanNet's 4x4)
/// matrix as text.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/camera.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace hypermap {

/// What such a file says; a text matrix says nothing about the size.
struct Intrinsics {
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  std::optional<int> width_px;
  std::optional<int> height_px;
  std::optional<double> depth_units_per_m;
  friend bool operator==(const Intrinsics&, const Intrinsics&) = default;
};

/// Errors: kIo; kLimit (1 MiB); kMalformedFile naming the field: missing, no number, not finite,
/// focal length <= 0, side outside 1 .. 65535 or no integer, centre outside the image by more
/// than half its side, depth_scale <= 0. Findings: unknown keys; distortion, which is not applied.
[[nodiscard]] Result<Loaded<Intrinsics>> read_intrinsics(const std::filesystem::path& path);

/// What is to be said of a vertical focal length that is negative: the camera's y points up. Which
/// world its poses are in, a mirrored one or not, differs between datasets, so it is not read.
/// Empty for any other.
[[nodiscard]] std::string rows_up_hint(double fy_px);

/// A camera of the stated size, or of the given one where none is stated.
/// Errors: kInvalidArgument when both are there and disagree; those of `validate(PinholeCamera)`.
[[nodiscard]] Result<PinholeCamera> camera_of(const Intrinsics& intrinsics,
                                              int width_px,
                                              int height_px);

/// Our JSON form, newline included.
[[nodiscard]] std::string to_intrinsics_json(const PinholeCamera& camera, double depth_units_per_m);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where things are in a dataset's folder and what they mean: the content of a `dataset.yaml`.
///
/// The known layouts are such descriptions too, made by looking (`find_layout`).
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/depth_file.hpp"
#include "hypermap/io/dataset/intrinsics_file.hpp"

#include <Eigen/Geometry>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hypermap {

/// How poses find their images.
enum class PosePairing {
  kStamp,   ///< Nearest stamp within the tolerance.
  kNumber,  ///< Record number, or number in the pose file's name, equals the image's number.
  kOrder,   ///< The n-th pose belongs to the n-th image.
};

enum class TrajectoryFormat {
  kTum,     ///< Lines `t tx ty tz qx qy qz qw`.
  kLog,     ///< Open3D's records of a header and a 4x4 matrix.
  kMatrix,  ///< A file with one 4x4 matrix for each image.
  kLines,   ///< A line for each image, without stamp: `read_pose_lines`.
};

enum class PoseDirection { kCameraToWorld, kWorldToCamera };

/// Axes of the camera that the poses are about.
enum class CameraAxes {
  kOptical,  ///< x right, y down, z forward.
  kOpenGl,   ///< x right, y up, z backward.
  kRobot,    ///< x forward, y left, z up.
};

/// Paths are relative to the dataset's folder. A pattern has one `*` in its last part, which stands
/// for the image's number or stamp.
struct DatasetDescription {
  std::string layout = "described";
  std::string name;
  /// What the world that the poses are in is called; datasets that name the same share it. Empty:
  /// it has no name.
  std::string world;
  std::optional<Intrinsics> intrinsics;  ///< Of the colour camera, which depth is registered to.
  std::string intrinsics_file;           ///< Instead of `intrinsics`; empty: none.
  std::string depth;                     ///< A pattern, or a list file of lines `stamp path`.
  std::string color;                     ///< The same; empty: no colour.
  DepthFormat depth_format;
  /// False: `depth_scale` must come from the file of the intrinsics.
  bool names_depth_scale = true;
  std::string trajectory;  ///< A file, or with kMatrix a pattern.
  TrajectoryFormat trajectory_format = TrajectoryFormat::kTum;
  PosePairing pair_by = PosePairing::kStamp;
  PoseDirection pose_direction = PoseDirection::kCameraToWorld;
  CameraAxes camera_axes = CameraAxes::kOptical;
  std::optional<std::string> up_axis;   ///< x, -x, y, -y, z, -z
  std::vector<std::string> detections;  ///< Files, one detector each.
  double stamp_tolerance_s = 0.02;      ///< Range: 0 .. 3600
  double frame_rate_hz = 30.0;          ///< Stamps of images that only have numbers. 1e-3 .. 1e4
  /// Depth that is not registered to colour: its own camera, and where that is.
  std::optional<Intrinsics> depth_intrinsics;
  std::string depth_intrinsics_file;
  Eigen::Isometry3d color_from_depth = Eigen::Isometry3d::Identity();
  /// Nothing says whether depth is registered to colour: the images are asked.
  bool may_be_unregistered = false;
  /// Images of class numbers and of instances, which become detections; patterns or empty.
  std::string labels;
  std::string instances;
  std::string label_names;  ///< A file: what the numbers in them mean; empty: `read_label_names`.
};

/// What `depth_scale` looks like: how many units of a depth image are a metre.
inline constexpr std::string_view kDepthScaleExample = "depth_scale: 1000 (5000 in TUM RGB-D)";

/// Errors: those of `read_yaml`; kMalformedFile naming file, line and field: required keys are
/// missing (`intrinsics`, `depth`, `trajectory`, and `depth_scale` unless the intrinsics are a
/// file, which may name it), all of them named; a value of the wrong kind or outside its range, a
/// path that leaves the folder. Findings: unknown keys, with the nearest known one.
[[nodiscard]] Result<Loaded<DatasetDescription>> read_dataset_description(
    const std::filesystem::path& path);

/// What layout the folder has: a `dataset.yaml` in it comes first, then TUM RGB-D, 7-Scenes,
/// ScanNet export, Open3D.
///
/// Errors: kIo when the folder is not there; kNotFound when it has none, with what was looked for;
/// those of a `dataset.yaml`.
/// Findings: intrinsics that the folder lacks and that were taken from the dataset's publication.
[[nodiscard]] Result<Loaded<DatasetDescription>> find_layout(const std::filesystem::path& folder);

}  // namespace hypermap

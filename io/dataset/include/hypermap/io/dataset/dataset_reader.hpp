// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A posed RGB-D sequence from a folder, frame by frame, whatever its layout.
///
/// Layouts are found by looking: TUM RGB-D, 7-Scenes, Open3D, ScanNet export, or any folder with a
/// `dataset.yaml` (dataset_description.hpp). Depth, colour, pose and detections are paired by stamp
/// or by number.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/segmentation/detector_registry.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/io/dataset/dataset_description.hpp"
#include "hypermap/io/dataset/detections_file.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hypermap {

struct OptionTable;

struct DatasetOptions {
  /// A description from outside, its paths relative to the folder; none: look in the folder.
  std::optional<std::filesystem::path> description = std::nullopt;
  /// Detections files, one detector each. Empty: those that lie in the folder (`detections.jsonl`,
  /// `detections.json`, or what the description names). A file that does not say whose it is is
  /// that of the detector of its stem's name, label images are that of `labels`.
  std::vector<std::filesystem::path> detections = {};
  /// Whose they are, of the first ones of these files; empty: as above. A file that says another
  /// name is refused.
  std::vector<std::string> detector_names = {};
  /// False: detections in the folder are not read unless named above.
  bool find_detections = true;
  DetectionReadOptions detection_reading = {};
  /// Detectors that are known from elsewhere: the map that is gone on from, a network.
  DetectorRegistry detectors = {};
  /// Partners may be this far apart; none: the description's, else 0.02 s. Range: 0 .. 3600
  std::optional<double> stamp_tolerance_s = std::nullopt;
  std::size_t first = 0;   ///< Frames before it are left out.
  std::size_t stride = 1;  ///< Every n-th frame. Range: 1 .. 1,000,000
  std::optional<std::size_t> max_frames = std::nullopt;  ///< None: all. Range: 1 .. 1,000,000,000
  bool read_color = true;                                ///< False: frames have no colour image.
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const DatasetOptions& options);
[[nodiscard]] const OptionTable& option_table(const DatasetOptions& options);

/// What a folder holds, for messages and `info`.
struct DatasetSummary {
  std::string layout;  ///< "tum", "7scenes", "open3d", "scannet", "described"
  std::string name;    ///< Of the description, else of the folder.
  std::string world;   ///< Of the description: datasets that name the same share it; else empty.
  PinholeCamera camera;
  double depth_units_per_m = 0.0;
  /// How poses were read; frames have them as camera to world of optical axes.
  PoseDirection pose_direction = PoseDirection::kCameraToWorld;
  CameraAxes camera_axes = CameraAxes::kOptical;
  double stamp_tolerance_s = 0.0;
  std::size_t num_frames = 0;  ///< After first, stride and max_frames.
  std::size_t num_depth = 0;
  std::size_t num_color = 0;
  std::size_t num_poses = 0;
  DetectorRegistry detectors;  ///< Those of the options, and of the detections that were read.
  std::size_t num_detection_frames = 0;
  std::size_t num_detections = 0;
  std::optional<std::string> up_axis;  ///< "z", "-y" ... when the description says so.
  /// What the images say of a colour camera that depth is not registered to; empty where it is, or
  /// where the description has both cameras.
  std::string registration;
  std::vector<std::string> unpaired;  ///< Depth, colour or detections without partner, by name.
  std::vector<Finding> findings;      ///< Repairs and unknown keys of the files that were read.
};

/// A sequence. `read` is safe to call concurrently.
class DatasetReader {
 public:
  DatasetReader() = default;
  DatasetReader(const DatasetReader&) = delete;
  DatasetReader& operator=(const DatasetReader&) = delete;
  DatasetReader(DatasetReader&&) = delete;
  DatasetReader& operator=(DatasetReader&&) = delete;
  virtual ~DatasetReader() = default;

  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  /// How the dataset calls the frame. Requires: index < size().
  [[nodiscard]] virtual std::string frame_name(std::size_t index) const = 0;
  /// Frame `index` of `size()`; its `index` counts what stride leaves out as well.
  ///
  /// Errors, each naming the file; the other frames stay readable: kNotFound without pose or
  /// image; kMalformedFile for an image or pose that is none; kInvalidArgument for a wrong size;
  /// kIo when the system refuses to read a file that is there. Requires: index < size().
  [[nodiscard]] virtual Result<RgbdFrame> read(std::size_t index) const = 0;
  [[nodiscard]] virtual const DatasetSummary& summary() const noexcept = 0;

  [[nodiscard]] const PinholeCamera& camera() const noexcept { return summary().camera; }

  /// Turns the dataset's world into the map's; identity until set. See up_axis.hpp.
  void set_map_from_input(const MapFromInput& map_from_input) { map_from_input_ = map_from_input; }
  [[nodiscard]] const MapFromInput& map_from_input() const noexcept { return map_from_input_; }

 private:
  MapFromInput map_from_input_;
};

/// Opens the folder `path`. Images are read later, one by one; lists, poses and detections now.
/// Classes of the detections are added to `registry`.
///
/// Errors: those of validate(options); kNotFound when it is no known layout, with what was looked
/// for; kIo; those of DetectorRegistry::add; whatever the trajectory, intrinsics, detections and
/// description files give; kNotFound when there is no frame.
[[nodiscard]] Result<std::unique_ptr<DatasetReader>> open_dataset(const std::filesystem::path& path,
                                                                  const DatasetOptions& options,
                                                                  ClassRegistry& registry);

}  // namespace hypermap

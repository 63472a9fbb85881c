// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The options by which several commands say which frames of which dataset they mean.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/class_names.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"

#include <CLI/App.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hypermap::app {

struct DatasetArguments {
  std::string input;
  std::optional<std::string> description;
  std::optional<std::string> classes;
  std::size_t first = 0;
  std::size_t stride = 1;
  std::optional<double> stamp_tolerance_s;
  std::optional<std::size_t> max_frames;

  void add_to(CLI::App& command);
  /// All but which folder it is, and what describes it.
  void add_reading_to(CLI::App& command);
  /// Errors: those of read_class_names.
  [[nodiscard]] Result<DatasetOptions> options() const;
  /// Errors: those of read_class_names.
  [[nodiscard]] Result<OnnxDetectorOptions> detector() const;
};

inline constexpr const char* kDescriptionHelp =
    "description of the folder, from outside it; must name intrinsics, depth, depth_scale, "
    "trajectory (docs/CLI.md)";

/// Files of the dataset's folder that look like detections and are not read unless named.
[[nodiscard]] std::vector<std::string> unused_detections(const std::filesystem::path& folder);

/// Files of detections, and whose words the first of them hold.
struct DetectionFiles {
  std::vector<std::string> files;
  std::vector<std::string> detectors;

  /// Gives the option of the files.
  CLI::Option& add_to(CLI::App& command);
  /// Throws CLI::ValidationError when there are more names than files.
  void keep_to_files() const;
  void put_into(DatasetOptions& options) const;
};

/// The only classes whose detections are used or written.
void add_keep_classes(CLI::App& command, std::vector<std::string>& names);

}  // namespace hypermap::app

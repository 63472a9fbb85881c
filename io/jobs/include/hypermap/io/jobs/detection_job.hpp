// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Runs a detector over a whole dataset and writes what it said.
#pragma once

#include "hypermap/core/base/job_progress.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/io/dataset/dataset_reader.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {

struct DetectionJob {
  std::filesystem::path input;
  std::filesystem::path model;
  /// `.jsonl`: a line of JSON for each image; anything else: COCO results.
  std::filesystem::path output;
  DatasetOptions dataset;
  OnnxDetectorOptions detector;
  /// Names of the only classes whose detections are written, in any spelling; empty: all.
  std::vector<std::string> wanted_class_names = {};
};

struct DetectionJobReport {
  NetworkForm network_form = NetworkForm::kAuto;  ///< Of the network.
  std::size_t num_frames = 0;
  std::size_t num_detections = 0;  ///< Written.
  std::size_t num_filtered = 0;    ///< Left out, being most probably of a class that is not wanted.
  std::vector<Error> skipped;      ///< Frames that could not be read, by name.
  std::vector<Finding> findings;   ///< Wanted classes that the network does not have.
};

/// Errors: those of open_dataset, OnnxDetector::load and of writing; kNotFound when no frame has a
/// colour image. Nothing is written on an error.
[[nodiscard]] Result<DetectionJobReport> run_detection(const DetectionJob& job,
                                                       const JobProgress& progress = {});

}  // namespace hypermap

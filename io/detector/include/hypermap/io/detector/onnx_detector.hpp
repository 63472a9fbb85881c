// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Detections of a YOLOX network in an ONNX file, computed on the processor by OpenCV.
///
/// Source: Z. Ge et al., "YOLOX: Exceeding YOLO Series in 2021": anchor-free grids of strides 8, 16
/// and 32, a row of x, y, w, h, objectness and class probabilities for each cell.
/// Scope: networks of that form with a square input and classes as sigmoid outputs.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace hypermap {

struct OptionTable;

struct OnnxDetectorOptions {
  double min_score = 0.25;    ///< Objectness times class probability must exceed it. Range: 0 .. 1
  double nms_overlap = 0.45;  ///< Of two boxes of a class with more IoU the better stays. 0 .. 1
  int input_side_px = 416;    ///< The image is fitted into this square. A multiple of 32, 32..2048
  std::size_t max_detections = 1000;  ///< The best of an image are kept. Range: 1 .. 1000
  DetectorId detector{0};             ///< Written into the detections.
  /// 0: one for each core. Range: 0 .. 256. OpenCV has one such number for the whole process, and
  /// it is that of the detector loaded last.
  int num_threads = 0;
  /// What the network's class outputs mean, in order. Empty: `coco_class_names()`.
  std::vector<std::string> class_names = {};
};

/// Errors: kInvalidArgument naming the field.
[[nodiscard]] Result<void> validate(const OnnxDetectorOptions& options);
[[nodiscard]] const OptionTable& option_table(const OnnxDetectorOptions& options);

/// A network that is loaded and ready. Movable, not copyable.
class OnnxDetector {
 public:
  /// Adds the classes to `registry`. Runs the network once on a grey image to see that its output
  /// has the expected shape.
  /// Errors: kIo; kMalformedFile when it is no network or its output does not fit input size and
  /// class count; kInvalidArgument as `validate`.
  [[nodiscard]] static Result<OnnxDetector> load(const std::filesystem::path& model,
                                                 const OnnxDetectorOptions& options,
                                                 ClassRegistry& registry);
  OnnxDetector(OnnxDetector&&) noexcept;
  OnnxDetector& operator=(OnnxDetector&&) noexcept;
  ~OnnxDetector();

  /// Best first. Class vectors are the network's class probabilities scaled to sum 1; `score` is
  /// objectness times the best class probability. Boxes are clipped to the image.
  ///
  /// Errors: kInvalidArgument for an empty image; kMalformedFile when the network fails on it or
  /// gives numbers that are not finite. Cost: about 45 ms for YOLOX-nano on one core.
  /// Threads: not safe to call concurrently on one detector. Same image, same bytes, at any
  /// number of threads.
  [[nodiscard]] Result<std::vector<Detection>> detect(const ColorImage& image);

  /// Ids of the classes in the network's order.
  [[nodiscard]] std::span<const ClassId> classes() const noexcept;

 private:
  struct Impl;
  explicit OnnxDetector(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Detections of a network in an ONNX file, computed on the processor by OpenCV.
///
/// Source: Z. Ge et al., "YOLOX: Exceeding YOLO Series in 2021"; N. Carion et al., "End-to-End
/// Object Detection with Transformers", 2020; X. Li et al., "Generalized Focal Loss", 2020.
/// Scope: networks of a `NetworkForm` with one square input image.
#pragma once

#include "hypermap/core/base/class_registry.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "hypermap/io/detector/network_form.hpp"

#include <array>
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
  /// The image is fitted into this square; 0: that of the network's file, else 416. 32 .. 2048, a
  /// multiple of 32 for forms with grids.
  int input_side_px = 0;
  std::size_t max_detections = 1000;  ///< The best of an image are kept. Range: 1 .. 1000
  NetworkForm network_form = NetworkForm::kAuto;     ///< What the outputs mean.
  ImageFit image_fit = ImageFit::kAuto;              ///< How the image lies in the square.
  ChannelOrder channel_order = ChannelOrder::kAuto;  ///< In which order colours go in.
  /// Taken off each channel's values of 0 .. 255, in the order in which they go in, where
  /// `channel_stddev` is given. Range: 0 .. 255
  std::array<double, 3> channel_mean{0.0, 0.0, 0.0};
  /// What is left is divided by this, in the unit of the values. 0: both as networks of the form
  /// are usually trained. Range: 0, or 0.001 .. 1000
  std::array<double, 3> channel_stddev{0.0, 0.0, 0.0};
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
  /// Adds the classes to `registry`. Runs the network once on a grey image to see what its outputs
  /// are.
  /// Errors: kIo; kMalformedFile when it is no network, when its input is no square, or when its
  /// outputs fit no form, or not the one that is asked for, for input size and class count: with
  /// the shapes that it has and those of the forms; kInvalidArgument as `validate`.
  [[nodiscard]] static Result<OnnxDetector> load(const std::filesystem::path& model,
                                                 const OnnxDetectorOptions& options,
                                                 ClassRegistry& registry);
  OnnxDetector(OnnxDetector&&) noexcept;
  OnnxDetector& operator=(OnnxDetector&&) noexcept;
  ~OnnxDetector();

  /// Best first. Class vectors are the network's class probabilities scaled to sum 1, of a network
  /// that names one class alone as `spread_score` makes them; `score` is the best class
  /// probability, times objectness where there is one. Boxes are clipped to the image.
  ///
  /// Errors: kInvalidArgument for an empty image; kMalformedFile when the network fails on it or
  /// gives numbers that are not finite. Cost: about 45 ms for YOLOX-nano on one core.
  /// Threads: not safe to call concurrently on one detector. Same image, same bytes, at any
  /// number of threads.
  [[nodiscard]] Result<std::vector<Detection>> detect(const ColorImage& image);

  /// Ids of the classes in the network's order.
  [[nodiscard]] std::span<const ClassId> classes() const noexcept;

  /// What the outputs were found to mean; never `kAuto`.
  [[nodiscard]] NetworkForm form() const noexcept;

  /// Detections bear this id from now on; 0 before.
  void set_id(DetectorId id) noexcept;

 private:
  struct Impl;
  explicit OnnxDetector(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"

#include <string>

namespace hypermap {
namespace {

constexpr OptionRow kOnnxRows[] = {
    option::number<&OnnxDetectorOptions::min_score>(
        "min_score", {0, 1}, {.effect = "Objectness times class probability must exceed it."}),
    option::number<&OnnxDetectorOptions::nms_overlap>(
        "nms_overlap",
        {0, 1},
        {.source = "YOLOX", .effect = "Of two boxes of a class with more IoU the better stays."}),
    option::count<&OnnxDetectorOptions::input_side_px>(
        "input_side_px",
        {32, 2048},
        {.unit = "px", .source = "YOLOX-nano", .effect = "The image is fitted into this square."}),
    option::count<&OnnxDetectorOptions::max_detections>(
        "max_detections", {1, 1000}, {.effect = "The best of an image are kept."}),
    option::count<&OnnxDetectorOptions::num_threads>(
        "num_threads", {0, 256}, {.effect = "0: one for each core.", .is_listed = false}),
    option::names<&OnnxDetectorOptions::class_names>(
        "class_names",
        {.effect = "What the outputs mean, in order; the classes of COCO when empty."}),
};

/// The coarsest grid of the network has a cell for each 32 pixels.
Result<void> check_side(const OnnxDetectorOptions& options) {
  if (options.input_side_px % 32 == 0) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be a multiple of 32, is " + std::to_string(options.input_side_px),
              "input_side_px");
}

}  // namespace

const OptionTable& option_table(const OnnxDetectorOptions&) {
  static constexpr OptionTable kTable{kOnnxRows, kRule<check_side>};
  return kTable;
}

Result<void> validate(const OnnxDetectorOptions& options) {
  return check_options(options);
}

}  // namespace hypermap

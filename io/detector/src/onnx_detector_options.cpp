// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/base/option_rows.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"

#include <algorithm>
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
        option::zero_or(32, 2048),
        {.unit = "px",
         .effect = "The image is fitted into this square; 0: that of the network's file, else "
                   "416."}),
    option::choice<&OnnxDetectorOptions::network_form>(
        "network_form",
        kNetworkFormNames,
        {.effect = "What the network's outputs mean; auto: told by their shapes and names."}),
    option::choice<&OnnxDetectorOptions::image_fit>(
        "image_fit",
        kImageFitNames,
        {.effect = "Scaled to fit at the upper left or in the middle, or stretched to the square; "
                   "auto: as the form is usually trained."}),
    option::choice<&OnnxDetectorOptions::channel_order>(
        "channel_order",
        kChannelOrderNames,
        {.effect = "Of the input's channels; auto: as the form is usually trained."}),
    option::number<&OnnxDetectorOptions::channel_mean>(
        "channel_mean",
        {0, 255},
        {.unit = "of 255", .effect = "Taken off each channel, with channel_stddev."}),
    option::number<&OnnxDetectorOptions::channel_stddev>(
        "channel_stddev",
        option::zero_or(0.001, 1000),
        {.unit = "of 255",
         .effect = "Each channel is divided by it; 0: this and channel_mean as the form is "
                   "usually trained."}),
    option::count<&OnnxDetectorOptions::max_detections>(
        "max_detections", {1, 1000}, {.effect = "The best of an image are kept."}),
    option::count<&OnnxDetectorOptions::num_threads>(
        "num_threads", {0, 256}, {.effect = "0: one for each core.", .is_listed = false}),
    option::names<&OnnxDetectorOptions::class_names>(
        "class_names",
        {.effect = "What the outputs mean, in order; the classes of COCO when empty."}),
};

bool has_grids(NetworkForm form) {
  return form == NetworkForm::kYolox || form == NetworkForm::kYolov5 ||
         form == NetworkForm::kYolov8 || form == NetworkForm::kNanodet;
}

/// The coarsest grid of such a network has a cell for each 32 pixels.
Result<void> check_side(const OnnxDetectorOptions& options) {
  if (options.input_side_px % 32 == 0 || !has_grids(options.network_form)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be a multiple of 32, is " + std::to_string(options.input_side_px),
              "input_side_px");
}

/// Both are given or neither is.
Result<void> check_channels(const OnnxDetectorOptions& options) {
  const auto is_given = [](double number) { return number != 0.0; };
  const auto num_given = std::ranges::count_if(options.channel_stddev, is_given);
  if (num_given == 3) return {};
  if (num_given == 0 && std::ranges::none_of(options.channel_mean, is_given)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "must be above 0 for each channel where it or channel_mean is given",
              "channel_stddev");
}

Result<void> check_together(const OnnxDetectorOptions& options) {
  HYPERMAP_TRY(check_side(options));
  return check_channels(options);
}

}  // namespace

const OptionTable& option_table(const OnnxDetectorOptions&) {
  static constexpr OptionTable kTable{kOnnxRows, kRule<check_together>};
  return kTable;
}

Result<void> validate(const OnnxDetectorOptions& options) {
  return check_options(options);
}

}  // namespace hypermap

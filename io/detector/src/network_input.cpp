// SPDX-License-Identifier: BSD-3-Clause
#include "network_input.hpp"

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hypermap {
namespace {

constexpr double kPaddingGrey = 114.0;  // what the networks were trained with

using Channels = std::array<double, 3>;

// Mean and standard deviation of the red, green and blue of ImageNet's images.
constexpr Channels kImageNetMean{123.675, 116.28, 103.53};
constexpr Channels kImageNetStddev{58.395, 57.12, 57.375};

constexpr Channels all(double value) {
  return {value, value, value};
}

constexpr Channels reversed(const Channels& channels) {
  return {channels[2], channels[1], channels[0]};
}

InputConvention usual_convention(NetworkForm form) {
  switch (form) {
    case NetworkForm::kYolov5:
    case NetworkForm::kYolov8:
      return {.fit = ImageFit::kCentre, .order = ChannelOrder::kRgb, .stddev = all(255.0)};
    case NetworkForm::kSsd:
      return {.fit = ImageFit::kStretch,
              .order = ChannelOrder::kRgb,
              .mean = all(127.0),
              .stddev = all(128.0)};
    case NetworkForm::kDetr:
      return {.fit = ImageFit::kStretch,
              .order = ChannelOrder::kRgb,
              .mean = kImageNetMean,
              .stddev = kImageNetStddev};
    case NetworkForm::kNanodet:
      return {.fit = ImageFit::kStretch,
              .order = ChannelOrder::kBgr,
              .mean = reversed(kImageNetMean),
              .stddev = reversed(kImageNetStddev)};
    case NetworkForm::kMaskRcnn:
      return {.fit = ImageFit::kCorner, .order = ChannelOrder::kRgb, .stddev = all(255.0)};
    case NetworkForm::kAuto:
    case NetworkForm::kYolox:
      break;
  }
  return {};
}

/// Subtracts and divides in place, where that changes anything.
void normalize(cv::Mat& blob, const InputConvention& convention) {
  const std::size_t num_pixels = blob.total() / 3;
  for (std::size_t c = 0; c < 3; ++c) {
    if (convention.mean[c] == 0.0 && convention.stddev[c] == 1.0) continue;
    const auto mean = static_cast<float>(convention.mean[c]);
    const auto factor = static_cast<float>(1.0 / convention.stddev[c]);
    float* const begin = blob.ptr<float>() + c * num_pixels;
    std::transform(
        begin, begin + num_pixels, begin, [&](float value) { return (value - mean) * factor; });
  }
}

}  // namespace

InputConvention convention_of(NetworkForm form, const OnnxDetectorOptions& options) {
  InputConvention convention = usual_convention(form);
  if (options.image_fit != ImageFit::kAuto) convention.fit = options.image_fit;
  if (options.channel_order != ChannelOrder::kAuto && options.channel_order != convention.order) {
    convention.order = options.channel_order;
    convention.mean = reversed(convention.mean);
    convention.stddev = reversed(convention.stddev);
  }
  if (options.channel_stddev[0] > 0.0) {
    convention.mean = options.channel_mean;
    convention.stddev = options.channel_stddev;
  }
  return convention;
}

PixelBox InputPlacement::in_image(const PixelBox& in_input) const noexcept {
  return {(in_input.u_min_px - offset_u_px) / scale_u,
          (in_input.v_min_px - offset_v_px) / scale_v,
          (in_input.u_max_px - offset_u_px) / scale_u,
          (in_input.v_max_px - offset_v_px) / scale_v};
}

InputPlacement place(int image_width_px, int image_height_px, int side_px, ImageFit fit) {
  const double scale_u = static_cast<double>(side_px) / image_width_px;
  const double scale_v = static_cast<double>(side_px) / image_height_px;
  if (fit == ImageFit::kStretch) {
    return {.scale_u = scale_u, .scale_v = scale_v, .width_px = side_px, .height_px = side_px};
  }
  const double scale = std::min(scale_u, scale_v);
  const auto scaled = [&](int length) {
    return std::clamp(static_cast<int>(length * scale + 1e-9), 1, side_px);
  };
  InputPlacement placement{.scale_u = scale,
                           .scale_v = scale,
                           .width_px = scaled(image_width_px),
                           .height_px = scaled(image_height_px)};
  if (fit == ImageFit::kCentre) {
    placement.offset_u_px = (side_px - placement.width_px) / 2;
    placement.offset_v_px = (side_px - placement.height_px) / 2;
  }
  return placement;
}

cv::Mat network_input(const ColorImage& image,
                      const InputPlacement& placement,
                      int side_px,
                      const InputConvention& convention) {
  const cv::Mat whole(image.height_px(),
                      image.width_px(),
                      CV_8UC3,
                      // OpenCV has no read-only view; nothing is written through it.
                      const_cast<Rgb8*>(image.pixels().data()));
  cv::Mat square(side_px, side_px, CV_8UC3, cv::Scalar::all(kPaddingGrey));
  const cv::Rect filled(
      placement.offset_u_px, placement.offset_v_px, placement.width_px, placement.height_px);
  cv::Mat target = square(filled);
  cv::resize(whole, target, filled.size(), 0.0, 0.0, cv::INTER_LINEAR);
  const bool swaps_red_and_blue = convention.order == ChannelOrder::kBgr;
  cv::Mat blob = cv::dnn::blobFromImage(square, 1.0, cv::Size(), cv::Scalar(), swaps_red_and_blue);
  normalize(blob, convention);
  return blob;
}

}  // namespace hypermap

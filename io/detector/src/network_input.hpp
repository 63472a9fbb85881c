// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How an image becomes a network's input, and where a pixel of the input lies in the image.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/segmentation/detection.hpp"
#include "hypermap/io/detector/onnx_detector.hpp"

#include <opencv2/core/mat.hpp>

#include <array>

namespace hypermap {

/// A channel's input is (value of 0 .. 255 - mean) / stddev, in the order of the channels.
struct InputConvention {
  ImageFit fit = ImageFit::kCorner;
  ChannelOrder order = ChannelOrder::kBgr;
  std::array<double, 3> mean{0.0, 0.0, 0.0};
  std::array<double, 3> stddev{1.0, 1.0, 1.0};
};

/// What networks of the form are usually trained with, and what the options say instead.
[[nodiscard]] InputConvention convention_of(NetworkForm form, const OnnxDetectorOptions& options);

/// The part of the input that an image fills; u = image u * scale + offset.
struct InputPlacement {
  double scale_u = 1.0;  ///< Input pixels per image pixel.
  double scale_v = 1.0;
  int offset_u_px = 0;
  int offset_v_px = 0;
  int width_px = 1;
  int height_px = 1;

  [[nodiscard]] PixelBox in_image(const PixelBox& in_input) const noexcept;
};

/// Requires: an image, a side, no `kAuto`.
[[nodiscard]] InputPlacement place(int image_width_px,
                                   int image_height_px,
                                   int side_px,
                                   ImageFit fit);

/// 1 x 3 x side x side. Cost: that of scaling.
[[nodiscard]] cv::Mat network_input(const ColorImage& image,
                                    const InputPlacement& placement,
                                    int side_px,
                                    const InputConvention& convention);

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What the outputs of a detector's network mean, and what its input is.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace hypermap {

/// How boxes and classes lie in the outputs: C classes, N rows, an input of S pixels a side. Rows
/// of grids: one a cell of strides 8, 16, 32, or 8, 16, 32, 64.
enum class NetworkForm {
  kAuto,  ///< Told by the shapes of the outputs, by their names where two forms have one shape.
  /// 1 x N x (5 + C): centre and size by cell and stride, objectness, classes. [Ge et al. 2021]
  kYolox,
  /// 1 x N x (5 + C): centre and size in input pixels, objectness, classes; three rows a cell. With
  /// K prototypes of masks, 1 x K x H x W, K more numbers a row: a mask is where their sum by these
  /// is above 0.
  kYolov5,
  /// 1 x (4 + C) x N: centre and size in input pixels, classes; a row a cell. Of YOLO11 too.
  /// Prototypes as before.
  kYolov8,
  /// 1 x N x 4 and 1 x N x (C + 1): corners as shares of the input, classes after the background;
  /// or 1 x 1 x N x 7 of a DetectionOutput: image, class from 1 on, score, corners.
  kSsd,
  /// 1 x N x 4 and 1 x N x (C + 1): centre and size as shares of the input, logits of the classes
  /// and of no object. [Carion et al. 2020]
  kDetr,
  /// 1 x N x (C + 4 B): classes, then B logits of the distance to each side, in strides.
  /// [Li et al. 2020]
  kNanodet,
  /// N x 4: corners in input pixels; N labels from 1 on, N scores, N x K x H x W masks, K 1, C or
  /// C + 1, above 0.5 where the object is: of its box, or of the input when they have its size.
  kMaskRcnn,
};

/// How an image becomes the square input; what is left of it is grey.
enum class ImageFit {
  kAuto,     ///< As networks of the form are usually trained.
  kCorner,   ///< Scaled to fit, at the upper left.
  kCentre,   ///< Scaled to fit, in the middle.
  kStretch,  ///< Width and height each scaled to the side.
};

/// The order of the input's channels.
enum class ChannelOrder {
  kAuto,  ///< As networks of the form are usually trained.
  kBgr,
  kRgb,
};

/// By enumerator from 0 on, as options and flags call them.
inline constexpr std::array<std::string_view, 8> kNetworkFormNames{
    "auto", "yolox", "yolov5", "yolov8", "ssd", "detr", "nanodet", "mask_rcnn"};
inline constexpr std::array<std::string_view, 4> kImageFitNames{
    "auto", "corner", "centre", "stretch"};
inline constexpr std::array<std::string_view, 3> kChannelOrderNames{"auto", "bgr", "rgb"};

[[nodiscard]] constexpr std::string_view name_of(NetworkForm form) noexcept {
  return kNetworkFormNames[static_cast<std::size_t>(form)];
}

}  // namespace hypermap

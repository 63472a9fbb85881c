// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A rectangle of pixels.
#pragma once

namespace hypermap {

/// A rectangle of the image. Unit: pixel; y grows downwards.
struct ImageRect {
  double x_px = 0.0;  ///< Left edge.
  double y_px = 0.0;  ///< Upper edge.
  double width_px = 0.0;
  double height_px = 0.0;
  friend bool operator==(const ImageRect&, const ImageRect&) = default;
};

}  // namespace hypermap

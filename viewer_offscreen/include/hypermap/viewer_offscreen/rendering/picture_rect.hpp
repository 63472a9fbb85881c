// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A rectangle of pixels.
#pragma once

namespace hypermap {

/// A rectangle of the picture. Unit: pixel; y grows downwards.
struct PictureRect {
  double x_px = 0.0;  ///< Left edge.
  double y_px = 0.0;  ///< Upper edge.
  double width_px = 0.0;
  double height_px = 0.0;
  friend bool operator==(const PictureRect&, const PictureRect&) = default;
};

}  // namespace hypermap

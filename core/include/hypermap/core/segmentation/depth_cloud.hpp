// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// What a depth image measures: which pixels, where, and how exactly.
#pragma once

#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/segmentation/detection.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hypermap {

/// Whether a depth is a measurement: finite and positive.
[[nodiscard]] inline bool is_measured(float depth_m) {
  return depth_m > 0.0F && std::isfinite(depth_m);
}

/// Standard deviation of a structured-light sensor along its axis.
///
/// Source: K. Khoshelham, S. O. Elberink, Sensors 12, 2012: grows with the square of depth; the
/// coefficients are those of C. V. Nguyen et al., 3DIMPVT 2012: 1.2 mm + 1.9 mm (z - 0.4)^2.
/// Unit: metre.
[[nodiscard]] inline double axial_noise_m(double depth_m) {
  const double beyond_m = depth_m - 0.4;
  return 0.0012 + 0.0019 * beyond_m * beyond_m;
}

/// Whole pixels, half open: [u_begin, u_end) x [v_begin, v_end).
struct PixelRect {
  int u_begin = 0;
  int v_begin = 0;
  int u_end = 0;
  int v_end = 0;

  [[nodiscard]] bool empty() const noexcept { return u_begin >= u_end || v_begin >= v_end; }
  [[nodiscard]] int width() const noexcept { return u_end - u_begin; }
  [[nodiscard]] int height() const noexcept { return v_end - v_begin; }
  [[nodiscard]] bool contains(int u, int v) const noexcept {
    return u >= u_begin && u < u_end && v >= v_begin && v < v_end;
  }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// The smallest rectangle around both; an empty one has nothing to be around.
[[nodiscard]] inline PixelRect united(const PixelRect& a, const PixelRect& b) noexcept {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.u_begin, b.u_begin),
          std::min(a.v_begin, b.v_begin),
          std::max(a.u_end, b.u_end),
          std::max(a.v_end, b.v_end)};
}

/// The pixels of an image of that size whose centre lies in `box` after it grew by `margin_px` on
/// each side.
///
/// Boundary: empty when the box lies outside, is turned around, or has an edge that is NaN.
[[nodiscard]] PixelRect pixels_in(const PixelBox& box,
                                  int width_px,
                                  int height_px,
                                  double margin_u_px = 0.0,
                                  double margin_v_px = 0.0);

}  // namespace hypermap

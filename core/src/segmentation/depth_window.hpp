// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The depth in and around a detection's box, in the picture's order.
#pragma once

#include "hypermap/core/depth_cloud.hpp"
#include "hypermap/core/geometric_segmentation.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace hypermap {

/// A cut-out of a depth picture. Cells are pixels, row-major within `rect`.
struct DepthWindow {
  PixelRect rect;              ///< What is cut out: the box and its surroundings.
  PixelRect box;               ///< The box's own pixels, within `rect`.
  PixelRect tolerant_box;      ///< The box with room for a detector's inaccuracy.
  std::vector<float> depth_m;  ///< Smoothed; 0 where nothing was measured within range.
  std::vector<float> slope_x;  ///< Per column, x / z of its ray.
  std::vector<float> slope_y;  ///< Per row, y / z of its ray.

  [[nodiscard]] int width() const { return rect.width(); }
  [[nodiscard]] int height() const { return rect.height(); }
  [[nodiscard]] std::size_t size() const { return depth_m.size(); }
  /// Position of column `x`, row `y` of the window.
  [[nodiscard]] std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(x);
  }
  [[nodiscard]] Eigen::Vector3f point_in_camera(int x, int y) const {
    const float z = depth_m[cell(x, y)];
    return {slope_x[static_cast<std::size_t>(x)] * z, slope_y[static_cast<std::size_t>(y)] * z, z};
  }
  [[nodiscard]] bool in_box(int x, int y) const {
    return box.contains(x + rect.u_begin, y + rect.v_begin);
  }
  [[nodiscard]] bool outside(int x, int y) const {
    return !tolerant_box.contains(x + rect.u_begin, y + rect.v_begin);
  }
};

/// Cuts the window out and smooths it: each depth becomes the mean of its 3 x 3 neighbours on the
/// same surface. Empty when the box lies outside the picture.
[[nodiscard]] DepthWindow make_depth_window(const RgbdFrame& frame,
                                            const Detection& detection,
                                            const GeometricSegmentationOptions& options);

/// How much two neighbouring pixels of one surface may differ in depth around `depth_m`.
[[nodiscard]] inline float allowed_step_m(float depth_m, const ForegroundOptions& options) {
  return static_cast<float>(options.depth_step_m) +
         static_cast<float>(options.depth_step_per_m) * depth_m +
         static_cast<float>(axial_noise_m(static_cast<double>(depth_m)));
}

}  // namespace hypermap

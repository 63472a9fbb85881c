// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The depth in and around a detection's box, in the image's order.
#pragma once

#include "hypermap/core/segmentation/depth_cloud.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

/// The box of another detection of the frame.
struct CompetingBox {
  PixelBox box_px;
  PixelRect cells;  ///< Those of the window that lie in it.
};

/// A cut-out of a depth image in cells: pixels, or square blocks of them when the cut-out is
/// large. Row-major.
struct DepthWindow {
  PixelRect rect;          ///< What is cut out: the box and its surroundings. Unit: pixel.
  int block_px = 1;        ///< Edge of a cell.
  PixelBox box_px;         ///< The detection's box, or that around its mask.
  PixelRect box;           ///< The cells in the box.
  PixelRect tolerant_box;  ///< The cells in the box with room for a detector's inaccuracy.
  std::vector<CompetingBox> competing_boxes;  ///< Of other objects; those that have a cell here.
  /// A pixel a cell, 1 on those of the detection's mask; empty without one.
  MaskImage in_mask;
  int mask_tolerance = 0;      ///< Cells by which the mask's edge may be off.
  std::vector<float> depth_m;  ///< Smoothed; 0 where nothing was measured within range.
  std::vector<float> step_m;   ///< `allowed_step_m` of each depth.
  std::vector<float> slope_x;  ///< Per column, x / z of its ray.
  std::vector<float> slope_y;  ///< Per row, y / z of its ray.

  [[nodiscard]] int width() const { return static_cast<int>(slope_x.size()); }
  [[nodiscard]] int height() const { return static_cast<int>(slope_y.size()); }
  [[nodiscard]] std::size_t size() const { return depth_m.size(); }
  [[nodiscard]] bool is_masked() const { return !in_mask.empty(); }
  /// Whether the object may be there: in the mask, or anywhere when there is none.
  [[nodiscard]] bool may_be_object(std::size_t cell) const {
    return in_mask.empty() || in_mask.pixels()[cell] != 0;
  }
  /// Position of column `x`, row `y` of the window.
  [[nodiscard]] std::size_t cell(int x, int y) const {
    return static_cast<std::size_t>(y) * slope_x.size() + static_cast<std::size_t>(x);
  }
  /// Position of the cell that holds a pixel of the image. Requires: the pixel is in `rect`.
  [[nodiscard]] std::size_t cell_of_pixel(int u, int v) const {
    return cell((u - rect.u_begin) / block_px, (v - rect.v_begin) / block_px);
  }
  /// The first column of the image to the right of that pixel's cell.
  [[nodiscard]] int end_of_cell(int u) const {
    return u - (u - rect.u_begin) % block_px + block_px;
  }
  /// The pixel in the middle of a cell.
  [[nodiscard]] int pixel_u(int x) const {
    return std::min(rect.u_begin + x * block_px + block_px / 2, rect.u_end - 1);
  }
  [[nodiscard]] int pixel_v(int y) const {
    return std::min(rect.v_begin + y * block_px + block_px / 2, rect.v_end - 1);
  }
  [[nodiscard]] Eigen::Vector3f point_in_camera(int x, int y) const {
    const float z = depth_m[cell(x, y)];
    return {slope_x[static_cast<std::size_t>(x)] * z, slope_y[static_cast<std::size_t>(y)] * z, z};
  }
};

/// Cuts the window out and smooths it: each depth becomes the mean of its 3 x 3 pixels on the same
/// surface. Independent noise falls to a third, which is what lifts a keyboard out of its table.
/// Empty when the box lies outside the image; where there is a mask, the box is that around it.
/// `others` are all detections of the image.
[[nodiscard]] DepthWindow make_depth_window(const RgbdFrame& frame,
                                            const Detection& detection,
                                            std::span<const Detection> others,
                                            const GeometricSegmentationOptions& options);

/// How much two neighbouring pixels of one surface may differ in depth around `depth_m`.
[[nodiscard]] inline float allowed_step_m(float depth_m, const ForegroundOptions& options) {
  const double depth = static_cast<double>(depth_m);
  return static_cast<float>(options.depth_step_m + options.depth_step_per_m * depth +
                            axial_noise_m(depth));
}

}  // namespace hypermap

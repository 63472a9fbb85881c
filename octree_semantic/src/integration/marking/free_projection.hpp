// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Free space of a frame without rays: voxels are projected into the depth image.
#pragma once

#include "bit_window.hpp"
#include "corner_bits.hpp"
#include "depth_pyramid.hpp"
#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "integration/workers.hpp"
#include "kernels/kernels.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hypermap {

/// Finds the voxels that the measurements of a frame looked through.
///
/// A voxel was looked through when any of its eight corners is in front of what was measured at the
/// pixel in which the corner falls. Centres would not do: rays that only clip a voxel free it too,
/// at the edge of an object in the image and along a surface seen at a grazing angle, and a map
/// made with centres keeps what rays would have removed (2 to 5 % more occupied voxels in real
/// frames). The corners are shared by eight voxels, so they cost no more than centres.
///
/// Bricks wholly in front of all that was measured around them, or wholly behind, are not looked at
/// corner by corner. That changes no bit of the result.
class FreeProjection {
 public:
  /// Sets the bits in `passed`, and no others than those of bricks of the window. Throws
  /// std::bad_alloc.
  void mark(const RgbdFrame& frame,
            const DepthPyramid& pyramid,
            double resolution_m,
            double max_range_m,
            const WindowGeometry& window,
            const Workers& workers,
            BitLayer& passed);

 private:
  enum class VisibleCorners : std::uint8_t { kNothing, kSome, kAll };

  void set_up(const RgbdFrame& frame,
              const DepthPyramid& pyramid,
              double resolution_m,
              double max_range_m,
              const WindowGeometry& window);
  void test_column(const DepthPyramid& pyramid, std::size_t column, const WindowGeometry& window);
  [[nodiscard]] VisibleCorners test_brick(const DepthPyramid& pyramid,
                                          const std::array<float, 3>& first,
                                          BrickWords& corners) const;
  void mark_column(std::size_t column, const WindowGeometry& window, BitLayer& passed) const;
  [[nodiscard]] const BrickWords& corners_of(std::size_t brick) const noexcept;

  kernels::CornerProjection projection_;
  std::array<double, 3> origin_{};                    // the window's first corner in the camera
  std::array<std::array<double, 3>, 3> per_brick_{};  // steps along the map's axes, in the camera
  std::array<float, 3> middle_{};  // from a brick's first corner to the middle of its corners
  std::array<float, 3> half_{};    // half the extent of its corners along the camera's axes
  float radius_m_ = 0.0F;          // of the ball around its corners
  float max_range_m_ = 0.0F;
  std::vector<VisibleCorners> visible_corners_;
  std::vector<BrickWords> corners_;  // valid where kSome
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The outline of a set of pixels as a polygon.
///
/// Source: [mc] W. Lorensen, H. Cline, Marching Cubes, SIGGRAPH 1987, in the plane: an outline goes
/// through the middles of the edges between pixels that are set and those that are not.
#pragma once

#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/polygon.hpp"
#include "plan_mask.hpp"

#include <Eigen/Core>

namespace hypermap {

/// Where the pixels of a mask lie. Unit: metre.
struct MaskFrame {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< Of pixel (0, 0): its least coordinates.
  double edge_m = 1.0;                               ///< Of a pixel.

  [[nodiscard]] Eigen::Vector2d centre(int col, int row) const noexcept {
    return corner + edge_m * Eigen::Vector2d(col + 0.5, row + 0.5);
  }
};

/// The outer ring of the part that the first set pixel belongs to, without corners that lie within
/// a quarter of a pixel of the ring without them (Douglas and Peucker, 1973).
///
/// Requires: no two set pixels touch in a corner alone.
/// Errors: kNotFound when nothing is set. Cost: O(pixels + corners log corners).
[[nodiscard]] Result<Polygon> outline_of(const PlanMask& mask, const MaskFrame& frame);

}  // namespace hypermap

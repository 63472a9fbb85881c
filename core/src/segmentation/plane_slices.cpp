// SPDX-License-Identifier: BSD-3-Clause
#include "plane_slices.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace hypermap {
namespace {

/// The depth of a slice changes otherwise than the plane's by this share of the larger change.
constexpr float kLeastDifference = 0.75F;
/// Changes of less than this share of a step between surfaces tell nothing.
constexpr float kLeastOfStep = 0.3F;

/// Depth at which the ray of a cell meets the plane; infinite where it does not.
float plane_depth_m(const DepthWindow& window, const Plane& plane, int x, int y) {
  const Eigen::Vector3f ray(
      window.slope_x[static_cast<std::size_t>(x)], window.slope_y[static_cast<std::size_t>(y)], 1);
  const float depth_m = -plane.offset_m / plane.normal.dot(ray);
  return depth_m > 0.0F ? depth_m : std::numeric_limits<float>::infinity();
}

/// Whether a surface goes on from one cell to the one below it.
bool continues(const DepthWindow& window, std::size_t upper, std::size_t lower) {
  const float upper_m = window.depth_m[upper];
  const float lower_m = window.depth_m[lower];
  return upper_m > 0.0F && lower_m > 0.0F &&
         std::abs(upper_m - lower_m) <= std::max(window.step_m[upper], window.step_m[lower]);
}

/// Whether the cells of a column from `begin` up to `end`, which are on the plane, are a slice of
/// what is above and below them. Requires: rows there.
bool is_slice(const DepthWindow& window, const Plane& plane, int x, int begin, int end) {
  const std::size_t above = window.cell(x, begin - 1);
  const std::size_t below = window.cell(x, end);
  if (!continues(window, above, window.cell(x, begin)) ||
      !continues(window, window.cell(x, end - 1), below))
    return false;
  const float change_m = window.depth_m[above] - window.depth_m[below];
  const float plane_change_m =
      plane_depth_m(window, plane, x, begin - 1) - plane_depth_m(window, plane, x, end);
  if (!std::isfinite(plane_change_m)) return true;  // not seen from here
  const float larger_m = std::max(std::abs(change_m), std::abs(plane_change_m));
  return larger_m > kLeastOfStep * window.step_m[below] &&
         std::abs(change_m - plane_change_m) >= kLeastDifference * larger_m;
}

}  // namespace

std::vector<std::uint8_t> without_slices(const DepthWindow& window,
                                         const std::vector<Plane>& planes,
                                         std::vector<std::uint8_t> plane_of_cell) {
  for (int x = 0; x < window.width(); ++x) {
    for (int begin = 1; begin + 1 < window.height();) {
      const std::uint8_t number = plane_of_cell[window.cell(x, begin)];
      int end = begin + 1;
      while (end < window.height() && plane_of_cell[window.cell(x, end)] == number) ++end;
      const bool is_between = number != 0 && end < window.height() &&
                              plane_of_cell[window.cell(x, begin - 1)] == 0 &&
                              plane_of_cell[window.cell(x, end)] == 0;
      if (is_between && is_slice(window, planes[number - 1U], x, begin, end)) {
        for (int y = begin; y < end; ++y) plane_of_cell[window.cell(x, y)] = 0;
      }
      begin = end;
    }
  }
  return plane_of_cell;
}

}  // namespace hypermap

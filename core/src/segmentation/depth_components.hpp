// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Connected surfaces of a depth window.
#pragma once

#include "depth_window.hpp"

#include <cstdint>
#include <vector>

namespace hypermap {

/// The kind of cells that another detection's object has, and of those outside a mask.
inline constexpr std::uint8_t kOthersKind = 255;

/// One connected surface.
struct DepthComponent {
  std::uint8_t kind = 0;          ///< As given: 0, the plane it is part of, from 1, or kOthersKind.
  std::uint32_t num_in_box = 0;   ///< Its cells within the box.
  std::uint32_t num_outside = 0;  ///< Its cells outside the tolerant box.
  PixelRect bounds_in_box = {};   ///< Of its cells within the box. Unit: cell.

  PixelRect bounds = {};  ///< Of all its cells. Unit: cell.
  // Steps at the edges of cells in the box; with a mask, between cells of the mask alone.
  std::uint32_t num_before = 0;  ///< Steps in depth at its edge down to what it hides.
  std::uint32_t num_behind = 0;  ///< Steps in depth at its edge up to what hides it.

  /// Share of its depth edges that are its own outline; 0.5 when it has none. An object that stands
  /// free has 1, the wall seen through the back of a chair 0.
  [[nodiscard]] double outline_share() const {
    return (1.0 + num_before) / (2.0 + num_before + num_behind);
  }
  /// Share of the surface that lies outside the box.
  [[nodiscard]] double outside_share() const {
    const double all = static_cast<double>(num_in_box) + static_cast<double>(num_outside);
    return all > 0.0 ? static_cast<double>(num_outside) / all : 0.0;
  }
};

struct DepthComponents {
  std::vector<std::uint32_t> of_cell;  ///< Per cell its component; kNoComponent where none.
  std::vector<DepthComponent> components;
};

inline constexpr std::uint32_t kNoComponent = 0xFFFFFFFFU;

/// Joins cells of equal kind that are neighbours (across up to two pixels without measurement) and
/// differ in depth by no more than the step of one surface. Numbered by their first cell.
/// Cost: O(cells), two passes in the image's order.
[[nodiscard]] DepthComponents connected_components(const DepthWindow& window,
                                                   const std::vector<std::uint8_t>& kind_of_cell);

}  // namespace hypermap

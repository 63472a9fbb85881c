// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The level upper edge of an object below what a depth sensor does not measure.
#pragma once

#include "segmentation/depth_window.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hypermap {

/// A cell whose ray passes above the object's upper edge.
struct CellAbove {
  int x;
  int y;
};

/// The level upper edge of an object, from one side to the other. Frame: camera.
struct LevelEdge {
  float height_m = 0.0F;         ///< Above the camera; negative.
  std::vector<CellAbove> above;  ///< Ascending by column, one in each.
  std::vector<float> nearest_m;  ///< For each column of the window: a top begins behind its edge.
  /// For each column where the edge is not seen: what is nearer than this hides it, by its depth in
  /// the nearest column; infinite where it is seen.
  std::vector<float> hiding_m;
  Eigen::Vector3f middle_in_camera = Eigen::Vector3f::Zero();
  float length_m = 0.0F;
};

/// In the box and, where there is one, in the mask.
[[nodiscard]] bool is_unmeasured(const DepthWindow& window, std::size_t cell);

/// The ray through the lower border of a cell; that of the cell above it is its upper border.
/// Requires: two rows.
[[nodiscard]] Eigen::Vector3f lower_ray(const DepthWindow& window, int x, int y);

/// Depth at which a ray meets the plane of that height. Requires: it falls towards it.
[[nodiscard]] float plane_depth_m(const Eigen::Vector3f& up_in_camera,
                                  const Eigen::Vector3f& ray,
                                  float height_m);

/// The edge below the unmeasured, when most of it is of one height and it is the top of something
/// tall below the camera: no seat with a back. `is_object` is 1 on the cells of the object.
/// Requires: two rows. Cost: O(cells of the box).
[[nodiscard]] std::optional<LevelEdge> level_edge(const DepthWindow& window,
                                                  const std::vector<std::uint8_t>& is_object,
                                                  const Eigen::Vector3f& up_in_camera);

}  // namespace hypermap

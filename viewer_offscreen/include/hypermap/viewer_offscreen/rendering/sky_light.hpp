// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// How much of the sky a place sees over the voxels around it: soft light that shows what stands
/// near a wall, under a table or in the open.
#pragma once

#include "hypermap/viewer_offscreen/rendering/voxel_surface.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace hypermap {

/// The horizon over the plan, from the highest voxel of each column.
///
/// Scope: a height field: what is under a roof is dark, whatever comes in from the side.
class SkyLight {
 public:
  /// Cost: linear in the voxels; one float per column of the plan, at most 2^24 (columns grow with
  /// larger plans). Requires: `voxels` are few enough to index with 32 bits.
  explicit SkyLight(std::span<const OccupiedVoxel> voxels);

  /// Part of the light that reaches a face through the point before it: 1 in the open, towards 0 in
  /// a shaft. Upright faces look to one side only. Shade fades with distance and ends at 1 m.
  /// Cost: constant.
  [[nodiscard]] float at(const Eigen::Vector3f& point_in_map, FaceDirection face) const;

 private:
  struct Step {
    int col = 0;
    int row = 0;
    float per_rise = 0.0F;  ///< Tangent of the horizon per metre that a column rises there.
  };
  struct Direction {
    Eigen::Vector2f towards;
    std::vector<Step> steps;  ///< Outwards.
  };

  [[nodiscard]] float top_of(int col, int row) const;
  void measure_plan(std::span<const OccupiedVoxel> voxels);
  void plan_directions();

  float cell_m_ = 1.0F;
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  int cols_ = 0;
  int rows_ = 0;
  std::vector<float> top_m_;  ///< Row-major; the lowest float where nothing is.
  std::vector<Direction> directions_;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The ground as a camera sees it: which pixel shows a cell, and whether depth says that the ground
/// itself is seen there.
#pragma once

#include "hypermap/core/base/image.hpp"
#include "hypermap/core/base/result.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/projection/grids/grid_geometry.hpp"
#include "hypermap/projection/sensor_models/inverse_sensor_model.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace hypermap {

/// What of the ground is to be looked at.
struct GroundRange {
  HeightOptions heights;
  double resolution_m = 0.05;
  double max_range_m = 5.0;  ///< In the plan, from the camera.
};

/// A cell whose centre is in view, and where.
struct CellInView {
  Cell cell;
  int u_px = 0;
  int v_px = 0;
};

class GroundView {
 public:
  /// Errors: kLimit when the range holds too many cells. Requires: valid camera, pose and range.
  [[nodiscard]] static Result<GroundView> create(const PinholeCamera& camera,
                                                 const MapFromCamera& map_from_camera,
                                                 const GroundRange& range);

  /// A square around the camera.
  [[nodiscard]] const GridGeometry& geometry() const noexcept { return geometry_; }

  /// Those within range whose centre's pixel lies in the image, row by row from row 0. None from
  /// below the ground.
  [[nodiscard]] std::vector<CellInView> cells_in_view() const;
  /// Whether the pixel's depth ends on the ground. Boundary: no measurement does not.
  [[nodiscard]] bool is_ground(const CellInView& seen, const DepthImage& depth_m) const;
  /// Whether what a pixel measured lies on the ground.
  [[nodiscard]] bool is_near_ground(int u_px, int v_px, float depth_m) const;
  /// Where the ray of a point of the image meets the ground; none where it does not go down to it,
  /// or meets it out of range.
  [[nodiscard]] std::optional<Eigen::Vector2d> on_ground(const PixelPoint& pixel) const;

 private:
  GroundView(const PinholeCamera& camera,
             const MapFromCamera& map_from_camera,
             const GroundRange& range,
             const GridGeometry& geometry);

  PinholeCamera camera_;
  MapFromCamera map_from_camera_;
  GroundRange range_;
  GridGeometry geometry_;
  /// Takes (x, y, 1) of the ground to (u w, v w, w), w the depth.
  Eigen::Matrix3d image_from_ground_;
};

}  // namespace hypermap

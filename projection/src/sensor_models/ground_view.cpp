// SPDX-License-Identifier: BSD-3-Clause
#include "ground_view.hpp"

#include "cell_lattice.hpp"
#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <cmath>

namespace hypermap {
namespace {

/// Source: R. Hartley, A. Zisserman, "Multiple View Geometry", 2004, 8.1.1: of the plane z = h the
/// columns 1, 2 and 3 h + 4 of the camera's matrix.
Eigen::Matrix3d homography_of_ground(const PinholeCamera& camera,
                                     const MapFromCamera& map_from_camera,
                                     double ground_m) {
  const Eigen::Isometry3d camera_from_map = map_from_camera.isometry().inverse();
  Eigen::Matrix3d intrinsics;
  intrinsics << camera.fx_px, 0.0, camera.cx_px,  //
      0.0, camera.fy_px, camera.cy_px,            //
      0.0, 0.0, 1.0;
  Eigen::Matrix3d plane;
  plane.col(0) = camera_from_map.linear().col(0);
  plane.col(1) = camera_from_map.linear().col(1);
  plane.col(2) = ground_m * camera_from_map.linear().col(2) + camera_from_map.translation();
  return intrinsics * plane;
}

}  // namespace

GroundView::GroundView(const PinholeCamera& camera,
                       const MapFromCamera& map_from_camera,
                       const GroundRange& range,
                       const GridGeometry& geometry)
    : camera_(camera),
      map_from_camera_(map_from_camera),
      range_(range),
      geometry_(geometry),
      image_from_ground_(homography_of_ground(camera, map_from_camera, range.heights.ground_m)) {}

Result<GroundView> GroundView::create(const PinholeCamera& camera,
                                      const MapFromCamera& map_from_camera,
                                      const GroundRange& range) {
  const Eigen::Vector2d place = map_from_camera.origin().xyz.head<2>();
  const Eigen::Vector2d reach = Eigen::Vector2d::Constant(range.max_range_m);
  HYPERMAP_ASSIGN_OR_RETURN(const GridGeometry geometry,
                            lattice_around({place - reach, place + reach}, range.resolution_m));
  return GroundView(camera, map_from_camera, range, geometry);
}

std::vector<CellInView> GroundView::cells_in_view() const {
  std::vector<CellInView> cells;
  const Eigen::Vector3d eye = map_from_camera_.origin().xyz;
  if (eye.z() <= range_.heights.ground_m) return cells;
  const double max_squared = range_.max_range_m * range_.max_range_m;
  for (int row = 0; row < geometry_.rows; ++row) {
    for (int col = 0; col < geometry_.cols; ++col) {
      const Eigen::Vector2d place = centre(geometry_, {col, row});
      if ((place - eye.head<2>()).squaredNorm() > max_squared) continue;
      const Eigen::Vector3d image = image_from_ground_ * place.homogeneous();
      if (!(image.z() > 0.0)) continue;
      const double u = std::floor(image.x() / image.z() + 0.5);
      const double v = std::floor(image.y() / image.z() + 0.5);
      const bool is_in = u >= 0.0 && v >= 0.0 && u < camera_.width_px && v < camera_.height_px;
      if (is_in) cells.push_back({{col, row}, static_cast<int>(u), static_cast<int>(v)});
    }
  }
  return cells;
}

bool GroundView::is_near_ground(int u_px, int v_px, float depth_m) const {
  const PointInMap point =
      map_from_camera_ * camera_.unproject(u_px, v_px, static_cast<double>(depth_m));
  const double height_m = point.xyz.z() - range_.heights.ground_m;
  return std::abs(height_m) <= range_.heights.ground_tolerance_m;
}

bool GroundView::is_ground(const CellInView& seen, const DepthImage& depth_m) const {
  const float measured_m = depth_m.at(seen.u_px, seen.v_px);
  return is_measured(measured_m) && is_near_ground(seen.u_px, seen.v_px, measured_m);
}

std::optional<Eigen::Vector2d> GroundView::on_ground(const PixelPoint& pixel) const {
  const Eigen::Vector3d eye = map_from_camera_.origin().xyz;
  const Eigen::Vector3d along =
      map_from_camera_.isometry().linear() * camera_.unproject(pixel.u_px, pixel.v_px, 1.0).xyz;
  const double drop_m = eye.z() - range_.heights.ground_m;
  if (!(drop_m > 0.0 && along.z() < 0.0)) return std::nullopt;
  const Eigen::Vector2d offset = along.head<2>() * (drop_m / -along.z());
  if (!(offset.norm() <= range_.max_range_m)) return std::nullopt;
  return Eigen::Vector2d(eye.head<2>() + offset);
}

}  // namespace hypermap

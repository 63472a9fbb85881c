// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/snapshot/snapshot_camera.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace hypermap {
namespace {

constexpr double kNearestM = 0.05;
constexpr double kSmallestExtentM = 1.0;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

constexpr std::array<double, 2> kUnitInterval{-1.0, 1.0};

/// Corners of a cube of 2 m around the origin, shown when there is nothing to show.
std::vector<Eigen::Vector3d> default_points() {
  std::vector<Eigen::Vector3d> corners;
  for (const double x : kUnitInterval) {
    for (const double y : kUnitInterval) {
      for (const double z : kUnitInterval) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

/// Extent of points along an axis.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  [[nodiscard]] double centre() const { return 0.5 * (low + high); }
  [[nodiscard]] double length() const { return high - low; }
};

Extent extent_along(std::span<const Eigen::Vector3d> points, const Eigen::Vector3d& axis) {
  Extent extent;
  for (const Eigen::Vector3d& point : points) {
    extent.low = std::min(extent.low, axis.dot(point));
    extent.high = std::max(extent.high, axis.dot(point));
  }
  return extent;
}

/// The camera of a pose view at the size of the image: whole images keep their field of view
/// across the width.
PinholeCamera scaled_camera(const PoseView& view, double width_px, double height_px) {
  PinholeCamera camera;
  camera.width_px = static_cast<int>(width_px);
  camera.height_px = static_cast<int>(height_px);
  if (!view.camera) {
    camera.fx_px = 0.5 * width_px / std::tan(0.5 * radians(view.horizontal_fov_deg));
    camera.fy_px = camera.fx_px;
    camera.cx_px = 0.5 * (width_px - 1.0);
    camera.cy_px = 0.5 * (height_px - 1.0);
    return camera;
  }
  const double scale =
      std::min(width_px / view.camera->width_px, height_px / view.camera->height_px);
  camera.fx_px = scale * view.camera->fx_px;
  camera.fy_px = scale * view.camera->fy_px;
  // The centre of the image stays the centre; half a pixel because pixel 0 has its centre at 0.
  camera.cx_px =
      scale * (view.camera->cx_px + 0.5 - 0.5 * view.camera->width_px) + 0.5 * width_px - 0.5;
  camera.cy_px =
      scale * (view.camera->cy_px + 0.5 - 0.5 * view.camera->height_px) + 0.5 * height_px - 0.5;
  return camera;
}

/// OpenGL's clip coordinates of a pinhole camera: z forward, pixel centres at whole numbers.
Eigen::Matrix4d clip_from_camera(const PinholeCamera& camera, double near_m, double far_m) {
  const double width = camera.width_px;
  const double height = camera.height_px;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2.0 * camera.fx_px / width;
  clip(0, 2) = (2.0 * camera.cx_px + 1.0) / width - 1.0;
  clip(1, 1) = -2.0 * camera.fy_px / height;
  clip(1, 2) = 1.0 - (2.0 * camera.cy_px + 1.0) / height;
  clip(2, 2) = (far_m + near_m) / (far_m - near_m);
  clip(2, 3) = -2.0 * far_m * near_m / (far_m - near_m);
  clip(3, 2) = 1.0;
  return clip;
}

}  // namespace

std::optional<Eigen::Vector3d> direction_to_eye(const SnapshotView& view) {
  if (std::holds_alternative<TopView>(view)) return Eigen::Vector3d::UnitZ();
  const auto* iso = std::get_if<IsoView>(&view);
  if (iso == nullptr) return std::nullopt;
  const double azimuth = radians(iso->azimuth_deg);
  const double elevation = radians(iso->elevation_deg);
  return Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                         std::cos(elevation) * std::sin(azimuth),
                         std::sin(elevation));
}

SnapshotCamera SnapshotCamera::frame(const SnapshotOptions& options,
                                     std::span<const Eigen::Vector3d> points_in_map,
                                     const ImageRect& area) {
  SnapshotCamera camera;
  camera.width_px_ = options.width_px;
  camera.height_px_ = options.height_px;
  const std::vector<Eigen::Vector3d> fallback = default_points();
  const auto points =
      points_in_map.empty() ? std::span<const Eigen::Vector3d>(fallback) : points_in_map;
  if (const auto* pose = std::get_if<PoseView>(&options.view)) {
    camera.frame_pose(*pose, options, points);
  } else {
    camera.frame_parallel(options, points, area);
  }
  return camera;
}

void SnapshotCamera::look(const Eigen::Vector3d& backwards, const Eigen::Vector3d& right) {
  backwards_ = backwards;
  right_ = right.normalized();
  up_ = backwards_.cross(right_);
}

void SnapshotCamera::frame_parallel(const SnapshotOptions& options,
                                    std::span<const Eigen::Vector3d> points_in_map,
                                    const ImageRect& area) {
  const Eigen::Vector3d backwards = *direction_to_eye(options.view);
  const bool top = std::holds_alternative<TopView>(options.view);
  look(backwards, top ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ().cross(backwards));
  const Extent across = extent_along(points_in_map, right_);
  const Extent along = extent_along(points_in_map, up_);
  const Extent depth = extent_along(points_in_map, backwards_);
  const bool flat = std::max(across.length(), along.length()) <= 0.0;
  const double scale =
      std::min(area.width_px / std::max(across.length(), flat ? kSmallestExtentM : 1e-6),
               area.height_px / std::max(along.length(), flat ? kSmallestExtentM : 1e-6));
  pixels_per_m_ = scale;
  // Clip x runs from -1 at the left edge of the image; the scene's middle goes to the area's.
  const double sx = 2.0 * scale / width_px_;
  const double sy = 2.0 * scale / height_px_;
  const double middle_x = 2.0 * (area.x_px + 0.5 * area.width_px) / width_px_ - 1.0;
  const double middle_y = 1.0 - 2.0 * (area.y_px + 0.5 * area.height_px) / height_px_;
  const double half_depth = 0.5 * depth.length() + 2.0;
  clip_from_map_.row(0) << sx * right_.transpose(), middle_x - sx * across.centre();
  clip_from_map_.row(1) << sy * up_.transpose(), middle_y - sy * along.centre();
  clip_from_map_.row(2) << -backwards_.transpose() / half_depth, depth.centre() / half_depth;
  clip_from_map_.row(3) << 0.0, 0.0, 0.0, 1.0;
}

void SnapshotCamera::frame_pose(const PoseView& view,
                                const SnapshotOptions& options,
                                std::span<const Eigen::Vector3d> points_in_map) {
  const Eigen::Isometry3d& map_from_camera = view.map_from_camera.isometry();
  look(-map_from_camera.linear().col(2), map_from_camera.linear().col(0));
  eye_ = map_from_camera.translation();
  double far_m = 1.0;
  for (const Eigen::Vector3d& point : points_in_map) {
    far_m = std::max(far_m, (point - *eye_).norm() + 1.0);
  }
  const PinholeCamera camera = scaled_camera(view, options.width_px, options.height_px);
  clip_from_map_ = clip_from_camera(camera, kNearestM, far_m) * map_from_camera.inverse().matrix();
}

std::optional<PixelPoint> SnapshotCamera::project(const Eigen::Vector3d& point_in_map) const {
  const Eigen::Vector4d clip = clip_from_map_ * point_in_map.homogeneous();
  if (eye_ && clip.w() < kNearestM) return std::nullopt;
  return PixelPoint{0.5 * (clip.x() / clip.w() + 1.0) * width_px_ - 0.5,
                    0.5 * (1.0 - clip.y() / clip.w()) * height_px_ - 0.5};
}

}  // namespace hypermap

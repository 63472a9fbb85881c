// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Where a point of the map falls in an image.
#pragma once

#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/viewer_offscreen/rendering/image_rect.hpp"
#include "hypermap/viewer_offscreen/snapshot/snapshot_options.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>

namespace hypermap {

/// The eye of an image. A value.
///
/// Pixels: as in PinholeCamera the centre of the upper left pixel is (0, 0).
class SnapshotCamera {
 public:
  /// Looks so that all `points_in_map` fall into `area` of an image of this size, centred, as
  /// large as possible; a pose view stays where it is and only takes its depth range from the
  /// points.
  ///
  /// Boundary: without points a cube of 2 m around the origin is framed; points that coincide are
  /// framed with 1 m around them. Requires: validate(options) passed; area inside the image.
  [[nodiscard]] static SnapshotCamera frame(const SnapshotOptions& options,
                                            std::span<const Eigen::Vector3d> points_in_map,
                                            const ImageRect& area);

  /// Shape: 4 x 4; OpenGL's clip space.
  [[nodiscard]] const Eigen::Matrix4d& clip_from_map() const noexcept { return clip_from_map_; }
  /// None behind the eye. May lie outside the image.
  [[nodiscard]] std::optional<PixelPoint> project(const Eigen::Vector3d& point_in_map) const;
  /// None for a perspective: there, lengths shrink with distance.
  [[nodiscard]] std::optional<double> pixels_per_m() const noexcept { return pixels_per_m_; }
  /// From the scene to the eye (parallel views), or where the eye stands (pose).
  [[nodiscard]] const Eigen::Vector3d& backwards_in_map() const noexcept { return backwards_; }
  [[nodiscard]] const std::optional<Eigen::Vector3d>& eye_in_map() const noexcept { return eye_; }
  /// Towards the right and the upper edge of the image.
  [[nodiscard]] const Eigen::Vector3d& right_in_map() const noexcept { return right_; }
  [[nodiscard]] const Eigen::Vector3d& up_in_map() const noexcept { return up_; }

 private:
  SnapshotCamera() = default;
  void look(const Eigen::Vector3d& backwards, const Eigen::Vector3d& right);
  void frame_parallel(const SnapshotOptions& options,
                      std::span<const Eigen::Vector3d> points_in_map,
                      const ImageRect& area);
  void frame_pose(const PoseView& view,
                  const SnapshotOptions& options,
                  std::span<const Eigen::Vector3d> points_in_map);

  double width_px_ = 0.0;
  double height_px_ = 0.0;
  Eigen::Matrix4d clip_from_map_ = Eigen::Matrix4d::Identity();
  Eigen::Vector3d backwards_ = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d right_ = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up_ = Eigen::Vector3d::UnitY();
  std::optional<Eigen::Vector3d> eye_ = std::nullopt;
  std::optional<double> pixels_per_m_ = std::nullopt;
};

/// From the scene to the eye of a view with parallel lines; none for a pose.
[[nodiscard]] std::optional<Eigen::Vector3d> direction_to_eye(const SnapshotView& view);

}  // namespace hypermap

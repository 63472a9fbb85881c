// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The rays of a view, and shapes that are elsewhere in each.
#pragma once

#include "embree_scene.hpp"
#include "hypermap/core/geometry/camera.hpp"
#include "hypermap/core/geometry/frames.hpp"

#include <Eigen/Geometry>

#include <cstddef>

namespace hypermap {

/// The rays of a view: direction (u, v) reaches 1 m of depth at parameter 1.
struct RayGrid {
  Eigen::Vector3d origin;
  Eigen::Matrix3d map_from_camera;
  PinholeCamera camera;

  RayGrid(const PinholeCamera& pinhole, const MapFromCamera& pose)
      : origin(pose.isometry().translation()),
        map_from_camera(pose.isometry().linear()),
        camera(pinhole) {}

  [[nodiscard]] Eigen::Vector3d direction(double u, double v) const {
    return map_from_camera * camera.unproject(u, v, 1.0).xyz;
  }

  /// Rays through pixels (u, v), (u + step, v), ...
  [[nodiscard]] EmbreeScene::Packet packet(int u, int step, int v) const {
    EmbreeScene::Packet directions;
    for (int i = 0; i < EmbreeScene::kPacket; ++i)
      directions[static_cast<std::size_t>(i)] = direction(u + i * step, v).cast<float>();
    return directions;
  }
};

/// A shape in its place in one view.
struct PosedBody {
  const EmbreeScene* shape;  ///< In the body's own frame.
  Eigen::Isometry3d map_from_body;
  Eigen::Isometry3f body_from_map;
};

[[nodiscard]] inline EmbreeScene::Packet moved_by(const Eigen::Isometry3f& motion,
                                                  EmbreeScene::Packet points) {
  for (Eigen::Vector3f& point : points) point = motion * point;
  return points;
}

[[nodiscard]] inline EmbreeScene::Packet turned_by(const Eigen::Isometry3f& motion,
                                                   EmbreeScene::Packet directions) {
  for (Eigen::Vector3f& direction : directions) direction = motion.linear() * direction;
  return directions;
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// A hand-made world and what sensors read in it: the ground z = 0, and a wall from x = 2.06 to
/// 2.19, across all y, 1.5 m high. The sensors stand at its origin or move with it.
#pragma once

#include "hypermap/core/segmentation/rgbd_frame.hpp"
#include "hypermap/projection/sensor_models/class_image_model.hpp"
#include "hypermap/projection/sensor_models/planar_scan_model.hpp"
#include "hypermap/projection/sensor_models/proximity_model.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace hypermap::test {

inline constexpr LogOddsSteps kHit = 847;    // ln(0.7 / 0.3) = 0.8473
inline constexpr LogOddsSteps kFree = -405;  // ln(0.4 / 0.6) = -0.4055
inline constexpr double kWallFrontM = 2.06;
inline constexpr double kWallBackM = 2.19;
inline constexpr double kWallTopM = 1.5;
inline constexpr double kNoReading = std::numeric_limits<double>::infinity();

/// How the world, sensors and all, lies in the map: shifted and turned about +z.
inline Eigen::Isometry3d placed(double x_m, double y_m, double yaw_rad = 0.0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(x_m, y_m, 0.0));
  pose.rotate(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  return pose;
}

/// At a height, looking along the world's +x, pitched down.
inline Eigen::Isometry3d mounted(double height_m, double pitch_rad = 0.0) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(0.0, 0.0, height_m));
  pose.rotate(Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()));
  return pose;
}

/// How far a ray goes, in lengths of `along`; infinite when it meets nothing.
inline double ray_length(const Eigen::Vector3d& from, const Eigen::Vector3d& along) {
  double length = kNoReading;
  if (along.z() < 0.0) length = from.z() / -along.z();
  if (along.x() > 0.0) {
    const double at_wall = (kWallFrontM - from.x()) / along.x();
    if (from.z() + at_wall * along.z() <= kWallTopM) length = std::min(length, at_wall);
  }
  return length;
}

/// Beams from -0.5 to 0.5 rad, a hundredth apart.
inline RangeScan scan_of_wall(const Eigen::Isometry3d& sensor_in_world,
                              const Eigen::Isometry3d& map_from_world) {
  RangeScan scan{.map_from_scanner = MapFromScanner(map_from_world * sensor_in_world),
                 .bearings_rad = {},
                 .ranges_m = {}};
  for (int i = -50; i <= 50; ++i) {
    const double bearing = i / 100.0;
    const Eigen::Vector3d along =
        sensor_in_world.linear() * Eigen::Vector3d(std::cos(bearing), std::sin(bearing), 0.0);
    scan.bearings_rad.push_back(bearing);
    scan.ranges_m.push_back(ray_length(sensor_in_world.translation(), along));
  }
  return scan;
}

inline RangeScan nothing_of(RangeScan scan) {
  const double none[] = {std::nan(""), -1.0, 0.0, kNoReading, -kNoReading};
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) scan.ranges_m[i] = none[i % 5];
  return scan;
}

/// 1.2 m high, 0.6 rad down: sees the ground from 0.7 m on, and the wall's foot.
inline Eigen::Isometry3d camera_in_world() {
  Eigen::Matrix3d optical;  // columns: the camera's x, y and z in a body of +x ahead, +z up
  optical << 0, 0, 1,       //
      -1, 0, 0,             //
      0, -1, 0;
  Eigen::Isometry3d pose = mounted(1.2, 0.6);
  pose.rotate(optical);
  return pose;
}

inline PinholeCamera wide_camera() {
  return {.width_px = 160,
          .height_px = 120,
          .fx_px = 100.0,
          .fy_px = 100.0,
          .cx_px = 79.5,
          .cy_px = 59.5};
}

inline RgbdFrame frame_of_wall(const Eigen::Isometry3d& map_from_world) {
  RgbdFrame frame;
  frame.name = "made";
  frame.camera = wide_camera();
  frame.map_from_camera = MapFromCamera(map_from_world * camera_in_world());
  frame.depth_m = DepthImage(frame.camera.width_px, frame.camera.height_px);
  const Eigen::Isometry3d eye = camera_in_world();
  for (int v = 0; v < frame.camera.height_px; ++v) {
    for (int u = 0; u < frame.camera.width_px; ++u) {
      const double depth_m =
          ray_length(eye.translation(), eye.linear() * frame.camera.unproject(u, v, 1.0).xyz);
      frame.depth_m.at(u, v) = static_cast<float>(depth_m);
    }
  }
  return frame;
}

inline RgbdFrame nothing_of(RgbdFrame frame) {
  const float none[] = {
      std::numeric_limits<float>::quiet_NaN(), -1.0F, 0.0F, std::numeric_limits<float>::infinity()};
  std::size_t i = 0;
  for (float& depth : frame.depth_m.pixels()) depth = none[i++ % 4];
  frame.detections.clear();
  return frame;
}

/// Where a point of the world appears to the camera at the world's origin.
inline PixelPoint pixel_of(double x_m, double y_m, double z_m) {
  const Eigen::Vector3d in_camera = camera_in_world().inverse() * Eigen::Vector3d(x_m, y_m, z_m);
  return wide_camera().project({in_camera}).value();
}

}  // namespace hypermap::test

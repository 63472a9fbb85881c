// SPDX-License-Identifier: BSD-3-Clause
#include "measured_points.hpp"

#include "hypermap/octree_semantic/voxel_key.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kCloudChunk = 1024;

bool is_measured(float depth_m) {
  return depth_m > 0.0F && std::isfinite(depth_m);
}

void include(Box& box, const Eigen::Vector3d& point) {
  box.min_in_map = box.min_in_map.cwiseMin(point);
  box.max_in_map = box.max_in_map.cwiseMax(point);
}

/// `voxels` from the origin as a key, kept within the volume.
int key_within_volume(double voxels) {
  return static_cast<int>(
      std::clamp(std::floor(voxels) + kOriginKey, 0.0, static_cast<double>(kKeysPerAxis - 1)));
}

}  // namespace

void MeasuredPoints::set_sensor(const PointInMap& sensor) {
  for (std::size_t i = 0; i < 3; ++i) {
    sensor_[i] = static_cast<float>(sensor.xyz[static_cast<Eigen::Index>(i)]);
  }
}

KeyBox MeasuredPoints::reach(double resolution_m, double max_range_m) const {
  const Box box = bounds();
  const double range_voxels = max_range_m / resolution_m + 2.0;
  KeyBox reach;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double sensor_voxels = static_cast<double>(sensor_[i]) / resolution_m;
    const double low = box.min_in_map[axis] / resolution_m - 1.0;
    const double high = box.max_in_map[axis] / resolution_m + 1.0;
    reach.min[i] = key_within_volume(std::max(low, sensor_voxels - range_voxels));
    reach.max[i] = key_within_volume(std::min(high, sensor_voxels + range_voxels));
  }
  return reach;
}

DepthPoints::DepthPoints(const RgbdFrame& frame) : frame_(&frame) {
  set_sensor(frame.map_from_camera.origin());
}

Box DepthPoints::bounds() const {
  float farthest_m = 0.0F;
  for (const float depth_m : frame_->depth_m.pixels()) {
    if (depth_m > farthest_m && std::isfinite(depth_m)) farthest_m = depth_m;
  }
  const PinholeCamera& camera = frame_->camera;
  const Eigen::Vector3d sensor = frame_->map_from_camera.origin().xyz;
  Box box{sensor, sensor};
  for (const int u : {0, camera.width_px - 1}) {
    for (const int v : {0, camera.height_px - 1}) {
      const auto corner = camera.unproject(u, v, static_cast<double>(farthest_m));
      include(box, (frame_->map_from_camera * corner).xyz);
    }
  }
  return box;
}

std::size_t DepthPoints::read(std::size_t first,
                              PointChunk& chunk,
                              IntegrationReport& report) const {
  const PinholeCamera& camera = frame_->camera;
  const auto width = static_cast<std::size_t>(camera.width_px);
  const std::size_t row_index = first / width;
  const auto v = static_cast<double>(row_index);
  const Eigen::Matrix3d rotation = frame_->map_from_camera.isometry().linear();
  const Eigen::Vector3d sensor = frame_->map_from_camera.isometry().translation();
  const Eigen::Vector3d row =
      rotation.col(1) * ((v - camera.cy_px) / camera.fy_px) + rotation.col(2);
  const Eigen::Vector3d per_column = rotation.col(0) / camera.fx_px;
  const float* depth_m = frame_->depth_m.pixels().data() + first;
  chunk.resize(width);
  for (std::size_t u = 0; u < width; ++u) {
    // Ray of the pixel times its depth; without branches, so that it is vectorised.
    const double column = static_cast<double>(static_cast<int>(u)) - camera.cx_px;
    const auto depth = static_cast<double>(depth_m[u]);
    chunk.x[u] = static_cast<float>((per_column.x() * column + row.x()) * depth + sensor.x());
    chunk.y[u] = static_cast<float>((per_column.y() * column + row.y()) * depth + sensor.y());
    chunk.z[u] = static_cast<float>((per_column.z() * column + row.z()) * depth + sensor.z());
  }
  for (std::size_t u = 0; u < width; ++u) {
    if (is_measured(depth_m[u])) continue;
    ++(std::isfinite(depth_m[u]) ? report.num_not_measured : report.num_not_finite);
    chunk.x[u] = kNotMeasured;
  }
  return width;
}

CloudPoints::CloudPoints(const PointInMap& sensor, std::span<const Eigen::Vector3f> points_in_map)
    : points_in_map_(points_in_map) {
  set_sensor(sensor);
}

Box CloudPoints::bounds() const {
  const Eigen::Vector3d sensor = Eigen::Vector3f(this->sensor().data()).cast<double>();
  Box box{sensor, sensor};
  for (const Eigen::Vector3f& point : points_in_map_) {
    if (point.allFinite()) include(box, point.cast<double>());
  }
  return box;
}

std::size_t CloudPoints::read(std::size_t first,
                              PointChunk& chunk,
                              IntegrationReport& report) const {
  const std::size_t size = std::min(kCloudChunk, points_in_map_.size() - first);
  chunk.resize(size);
  for (std::size_t i = 0; i < size; ++i) {
    const Eigen::Vector3f& point = points_in_map_[first + i];
    const bool finite = point.allFinite();
    if (!finite) ++report.num_not_finite;
    chunk.x[i] = finite ? point.x() : kNotMeasured;
    chunk.y[i] = point.y();
    chunk.z[i] = point.z();
  }
  return size;
}

}  // namespace hypermap

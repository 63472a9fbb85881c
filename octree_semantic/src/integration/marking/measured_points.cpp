// SPDX-License-Identifier: BSD-3-Clause
#include "measured_points.hpp"

#include "hypermap/octree_semantic/octree/voxel_key.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap {
namespace {

constexpr float kNotMeasured = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kCloudChunk = 1024;

void include(Box& box, const Eigen::Vector3d& point) {
  box.min_in_map = box.min_in_map.cwiseMin(point);
  box.max_in_map = box.max_in_map.cwiseMax(point);
}

/// `voxels` from the origin as a key, kept within the volume.
int key_within_volume(double voxels) {
  return static_cast<int>(
      std::clamp(std::floor(voxels) + kOriginKey, 0.0, static_cast<double>(kKeysPerAxis - 1)));
}

/// The sensor and the four corners of the image at the farthest depth.
Box box_of_view(const RgbdFrame& frame, double farthest_m) {
  const PinholeCamera& camera = frame.camera;
  const Eigen::Vector3d sensor = frame.map_from_camera.origin().xyz;
  Box box{sensor, sensor};
  for (const int u : {0, camera.width_px - 1}) {
    for (const int v : {0, camera.height_px - 1}) {
      include(box, (frame.map_from_camera * camera.unproject(u, v, farthest_m)).xyz);
    }
  }
  return box;
}

}  // namespace

void PointChunk::resize(std::size_t num_points) {
  size = num_points;
  const std::size_t padded = (num_points + kernels::kBlock - 1) / kernels::kBlock * kernels::kBlock;
  x.resize(padded);
  y.resize(padded);
  z.resize(padded);
}

void MeasuredPoints::set_sensor(const PointInMap& sensor) {
  for (std::size_t i = 0; i < 3; ++i) {
    sensor_[i] = static_cast<float>(sensor.xyz[static_cast<Eigen::Index>(i)]);
  }
}

KeyBox MeasuredPoints::key_bounds(double resolution_m, double max_range_m) const {
  const double range_voxels = max_range_m / resolution_m + 2.0;
  KeyBox key_bounds;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const double sensor_voxels = static_cast<double>(sensor_[i]) / resolution_m;
    const double low = bounds_.min_in_map[axis] / resolution_m - 1.0;
    const double high = bounds_.max_in_map[axis] / resolution_m + 1.0;
    key_bounds.min[i] = key_within_volume(std::max(low, sensor_voxels - range_voxels));
    key_bounds.max[i] = key_within_volume(std::min(high, sensor_voxels + range_voxels));
  }
  return key_bounds;
}

DepthPoints::DepthPoints(const RgbdFrame& frame) : frame_(&frame) {
  set_sensor(frame.map_from_camera.origin());
  const std::span<const float> depth_m = frame.depth_m.pixels();
  const float farthest_m = kernels::best_kernels().farthest(depth_m.data(), depth_m.size());
  set_bounds(box_of_view(frame, static_cast<double>(farthest_m)));
}

std::size_t DepthPoints::num_chunks() const {
  return static_cast<std::size_t>(frame_->camera.height_px);
}

std::size_t DepthPoints::points_per_chunk() const {
  return static_cast<std::size_t>(frame_->camera.width_px);
}

void DepthPoints::read(std::size_t index, PointChunk& chunk, IntegrationReport& report) const {
  const PinholeCamera& camera = frame_->camera;
  const Eigen::Matrix3d rotation = frame_->map_from_camera.isometry().linear();
  const Eigen::Vector3d sensor = frame_->map_from_camera.isometry().translation();
  const Eigen::Vector3d row =
      rotation.col(1) * ((static_cast<double>(index) - camera.cy_px) / camera.fy_px) +
      rotation.col(2);
  const Eigen::Vector3d per_column = rotation.col(0) / camera.fx_px;
  kernels::RowRays rays;
  rays.centre_column = camera.cx_px;
  for (int i = 0; i < 3; ++i) {
    rays.per_column[i] = per_column[i];
    rays.row[i] = row[i];
    rays.sensor[i] = sensor[i];
  }
  const auto width = static_cast<std::size_t>(camera.width_px);
  chunk.first = index * width;
  chunk.resize(width);
  const float* depth_m = frame_->depth_m.pixels().data() + chunk.first;
  const auto counts = kernels::best_kernels().unproject_row(rays, depth_m, width, chunk.row());
  report.num_not_measured += counts.num_not_measured;
  report.num_not_finite += counts.num_not_finite;
}

CloudPoints::CloudPoints(const PointInMap& sensor, std::span<const Eigen::Vector3f> points_in_map)
    : points_in_map_(points_in_map) {
  set_sensor(sensor);
  const Eigen::Vector3d rounded = Eigen::Vector3f(this->sensor().data()).cast<double>();
  Box box{rounded, rounded};
  for (const Eigen::Vector3f& point : points_in_map) {
    if (point.allFinite()) include(box, point.cast<double>());
  }
  set_bounds(box);
}

std::size_t CloudPoints::num_chunks() const {
  return (points_in_map_.size() + kCloudChunk - 1) / kCloudChunk;
}

std::size_t CloudPoints::points_per_chunk() const {
  return std::min(kCloudChunk, points_in_map_.size());
}

void CloudPoints::read(std::size_t index, PointChunk& chunk, IntegrationReport& report) const {
  chunk.first = index * kCloudChunk;
  chunk.resize(std::min(kCloudChunk, points_in_map_.size() - chunk.first));
  for (std::size_t i = 0; i < chunk.size; ++i) {
    const Eigen::Vector3f& point = points_in_map_[chunk.first + i];
    const bool finite = point.allFinite();
    if (!finite) ++report.num_not_finite;
    chunk.x[i] = finite ? point.x() : kNotMeasured;
    chunk.y[i] = point.y();
    chunk.z[i] = point.z();
  }
  std::fill(chunk.x.begin() + static_cast<std::ptrdiff_t>(chunk.size), chunk.x.end(), kNotMeasured);
}

}  // namespace hypermap

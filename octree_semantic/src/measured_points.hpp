// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The measurements of a frame or cloud as points of the map, chunk after chunk.
#pragma once

#include "bit_window.hpp"
#include "end_points.hpp"
#include "hypermap/octree_semantic/frame_integrator.hpp"
#include "point_f.hpp"

#include <cstddef>
#include <span>

namespace hypermap {

/// What the integrator needs to know of its measurements.
class MeasuredPoints {
 public:
  MeasuredPoints() = default;
  MeasuredPoints(const MeasuredPoints&) = delete;
  MeasuredPoints& operator=(const MeasuredPoints&) = delete;
  MeasuredPoints(MeasuredPoints&&) = delete;
  MeasuredPoints& operator=(MeasuredPoints&&) = delete;
  virtual ~MeasuredPoints() = default;

  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] const PointF& sensor() const noexcept { return sensor_; }
  /// Voxels that a ray to any of the measurements may touch, within the range.
  [[nodiscard]] KeyBox reach(double resolution_m, double max_range_m) const;
  /// Replaces the chunk by the next points from `first` on and returns how many. Points that are no
  /// measurement have x = NaN and are counted by reason.
  virtual std::size_t read(std::size_t first,
                           PointChunk& chunk,
                           IntegrationReport& report) const = 0;

 protected:
  /// A box around the sensor and all measurements, which may be infinite.
  [[nodiscard]] virtual Box bounds() const = 0;
  void set_sensor(const PointInMap& sensor);

 private:
  PointF sensor_{};
};

/// A depth image, row by row.
class DepthPoints final : public MeasuredPoints {
 public:
  /// Requires: `frame` is valid and outlives this.
  explicit DepthPoints(const RgbdFrame& frame);
  [[nodiscard]] std::size_t size() const override { return frame_->depth_m.size(); }
  std::size_t read(std::size_t first, PointChunk& chunk, IntegrationReport& report) const override;

 protected:
  [[nodiscard]] Box bounds() const override;

 private:
  const RgbdFrame* frame_;
};

/// Points in no order.
class CloudPoints final : public MeasuredPoints {
 public:
  /// Requires: the points outlive this.
  CloudPoints(const PointInMap& sensor, std::span<const Eigen::Vector3f> points_in_map);
  [[nodiscard]] std::size_t size() const override { return points_in_map_.size(); }
  std::size_t read(std::size_t first, PointChunk& chunk, IntegrationReport& report) const override;

 protected:
  [[nodiscard]] Box bounds() const override;

 private:
  std::span<const Eigen::Vector3f> points_in_map_;
};

}  // namespace hypermap

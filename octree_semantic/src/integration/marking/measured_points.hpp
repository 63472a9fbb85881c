// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// The measurements of a frame or cloud as points of the map, chunk after chunk.
#pragma once

#include "bit_window.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "kernels/kernels.hpp"
#include "octree/point_f.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace hypermap {

/// Points of a frame, a few hundred at a time. A point that was not measured has x = NaN; so have
/// those beyond `size`, up to a multiple of kernels::kBlock.
struct PointChunk {
  std::size_t first = 0;  ///< Which measurement the first of them is.
  std::size_t size = 0;
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;

  /// Makes room for `num_points`, padded. Throws std::bad_alloc.
  void resize(std::size_t num_points);
  [[nodiscard]] std::size_t padded_size() const noexcept { return x.size(); }
  [[nodiscard]] PointF point(std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
  [[nodiscard]] kernels::PointRow row() noexcept { return {x.data(), y.data(), z.data()}; }
};

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
  [[nodiscard]] virtual std::size_t num_chunks() const = 0;
  /// Of the largest chunk.
  [[nodiscard]] virtual std::size_t points_per_chunk() const = 0;
  [[nodiscard]] const PointF& sensor() const noexcept { return sensor_; }
  /// Voxels that a ray to any of the measurements may touch, within the range.
  [[nodiscard]] KeyBox key_bounds(double resolution_m, double max_range_m) const;
  /// Replaces the chunk by the `index`-th one. Points that are no measurement are counted by
  /// reason. Throws std::bad_alloc.
  virtual void read(std::size_t index, PointChunk& chunk, IntegrationReport& report) const = 0;

 protected:
  void set_sensor(const PointInMap& sensor);
  /// A box around the sensor and all measurements, which may be infinite.
  void set_bounds(const Box& bounds) { bounds_ = bounds; }

 private:
  PointF sensor_{};
  Box bounds_;
};

/// A depth image; a chunk is a row.
class DepthPoints final : public MeasuredPoints {
 public:
  /// Requires: `frame` is valid and outlives this.
  explicit DepthPoints(const RgbdFrame& frame);
  [[nodiscard]] const RgbdFrame& frame() const noexcept { return *frame_; }
  [[nodiscard]] std::size_t size() const override { return frame_->depth_m.size(); }
  [[nodiscard]] std::size_t num_chunks() const override;
  [[nodiscard]] std::size_t points_per_chunk() const override;
  void read(std::size_t index, PointChunk& chunk, IntegrationReport& report) const override;

 private:
  const RgbdFrame* frame_;
};

/// Points in no order.
class CloudPoints final : public MeasuredPoints {
 public:
  /// Requires: the points outlive this.
  CloudPoints(const PointInMap& sensor, std::span<const Eigen::Vector3f> points_in_map);
  [[nodiscard]] std::size_t size() const override { return points_in_map_.size(); }
  [[nodiscard]] std::size_t num_chunks() const override;
  [[nodiscard]] std::size_t points_per_chunk() const override;
  void read(std::size_t index, PointChunk& chunk, IntegrationReport& report) const override;

 private:
  std::span<const Eigen::Vector3f> points_in_map_;
};

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From measured points to the voxels in which measurements end and the rays that free the way.
#pragma once

#include "bit_window.hpp"
#include "cell_finder.hpp"
#include "hypermap/octree_semantic/frame_integrator.hpp"
#include "point_f.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// How far measurements count, with OctoMap's comparison: the root of the single-precision square
/// against the double-precision range.
class RangeLimit {
 public:
  explicit RangeLimit(double max_range_m) noexcept;
  [[nodiscard]] float range_m() const noexcept { return range_m_; }
  /// False for NaN.
  [[nodiscard]] bool contains(float squared_distance) const noexcept {
    return squared_distance <= max_squared_;
  }

 private:
  float range_m_;
  float max_squared_;
};

/// Points of a frame, a few hundred at a time. A point that was not measured has x = NaN.
struct PointChunk {
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> z;

  void resize(std::size_t size) {
    x.resize(size);
    y.resize(size);
    z.resize(size);
  }
};

/// A window and the bits that a frame sets in it.
struct MarkedWindow {
  WindowGeometry geometry;
  BitLayer bits;
};

/// Sorts the measurements of one frame into voxels and rays.
class EndPoints {
 public:
  /// `hit`: around the sensor, covers the range. `far`: covers all measurements, for those beyond
  /// the range; null when that would be too large. All bits are clear, all outlives this.
  EndPoints(double resolution_m,
            const PointF& sensor,
            const IntegrationOptions& options,
            MarkedWindow& hit,
            MarkedWindow* far,
            std::vector<PointF>& ray_ends);

  /// Takes the points of a chunk; writes the voxel of each (kNoCell when none) to `cells`, which
  /// has the chunk's size. Throws std::bad_alloc.
  void add(const PointChunk& chunk, std::span<std::uint32_t> cells, IntegrationReport& report);
  /// Call once after the last chunk. Mode discretize: makes one ray for each voxel.
  void finish();

 private:
  void add_beyond(const PointF& point, IntegrationReport& report);
  /// The point at the range toward `point`.
  [[nodiscard]] PointF shortened(const PointF& point) const noexcept;
  [[nodiscard]] PointF centre_of(const WindowGeometry& window,
                                 std::size_t brick,
                                 std::size_t cell) const noexcept;

  double resolution_m_;
  PointF sensor_;
  bool exact_;
  RangeLimit range_;
  RangeLimit outer_range_;  // discretize: nearer points end in voxels that may lie within the range
  MarkedWindow* hit_;
  MarkedWindow* far_;
  std::vector<PointF>* ray_ends_;
};

}  // namespace hypermap

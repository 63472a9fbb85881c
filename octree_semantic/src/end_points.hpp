// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From measured points to the voxels in which measurements end and the rays that free the way.
#pragma once

#include "bit_window.hpp"
#include "hypermap/octree_semantic/frame_integrator.hpp"
#include "point_f.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hypermap {

/// "No voxel".
inline constexpr std::uint32_t kNoCell = 0xFFFF'FFFF;

/// How far measurements count, with OctoMap's comparison: sqrt of the single-precision square
/// against the double-precision range.
class RangeLimit {
 public:
  explicit RangeLimit(double max_range_m) noexcept;
  [[nodiscard]] float range_m() const noexcept { return range_m_; }
  [[nodiscard]] bool contains(float squared_distance) const noexcept {
    return static_cast<double>(squared_distance) <= max_squared_;
  }

 private:
  float range_m_;
  double max_squared_;
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

/// Sorts the measurements of one frame into voxels and rays.
class EndPoints {
 public:
  /// `hit` and `left` are layers of `window`, all clear. Everything outlives this.
  EndPoints(const WindowGeometry& window,
            double resolution_m,
            const PointF& sensor,
            const IntegrationOptions& options,
            BitLayer& hit,
            BitLayer& left,
            std::vector<PointF>& ray_ends);

  /// Takes the points of a chunk; writes the voxel of each (kNoCell when none) to `cells`, which
  /// has the chunk's size. Throws std::bad_alloc.
  void add(const PointChunk& chunk, std::span<std::uint32_t> cells, IntegrationReport& report);
  /// Call once after the last chunk. Mode discretize: makes one ray for each voxel.
  void finish();

 private:
  [[nodiscard]] std::uint32_t cell_at(int x, int y, int z) const noexcept;
  [[nodiscard]] std::uint32_t cell_of(const PointF& point) const noexcept;
  [[nodiscard]] PointF centre_of(std::size_t brick, std::size_t cell) const noexcept;
  /// The point at the range toward `point`.
  [[nodiscard]] PointF shortened(const PointF& point) const noexcept;
  void add_beyond(const PointF& point, IntegrationReport& report);

  const WindowGeometry* window_;
  double resolution_m_;
  double voxels_per_m_;
  PointF sensor_;
  IntegrationMode mode_;
  RangeLimit range_;
  RangeLimit outer_range_;  // discretize: nearer points end in voxels that may lie within the range
  std::array<int, 3> first_inside_{};  // offsets of the window that lie in the volume
  std::array<std::uint32_t, 3> num_inside_{};
  BitLayer* hit_;
  BitLayer* left_;
  std::vector<PointF>* ray_ends_;
  std::array<std::vector<int>, 3> offsets_;
};

}  // namespace hypermap

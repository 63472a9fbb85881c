// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// From measured points to the voxels in which measurements end and the rays that free the way.
#pragma once

#include "bit_window.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "kernels/kernels.hpp"
#include "measured_points.hpp"
#include "octree/point_f.hpp"

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
  [[nodiscard]] float max_squared() const noexcept { return max_squared_; }
  /// False for NaN.
  [[nodiscard]] bool contains(float squared_distance) const noexcept {
    return squared_distance <= max_squared_;
  }

 private:
  float range_m_;
  float max_squared_;
};

/// The point at `range_m` from the sensor toward `point`, in OctoMap's single precision.
[[nodiscard]] PointF point_at_range(const PointF& sensor, const PointF& point, float range_m);

/// What one thread found of a frame's measurements, and its working memory.
struct EndSink {
  BitLayer hit;                        ///< Voxels in which measurements end.
  BitLayer far;                        ///< The same beyond the range, in a window of their own.
  std::vector<PointF> ray_ends;        ///< Rays from the sensor.
  std::vector<std::uint32_t> dropped;  ///< Measurements outside the volume: they count for nothing.
  IntegrationReport report;
  PointChunk chunk;

  std::vector<std::uint32_t> cells;  // of the chunk; the others too
  std::vector<std::uint32_t> far_cells;
  std::vector<std::uint64_t> starts;
  std::vector<std::uint64_t> far_bits;
  std::vector<std::uint64_t> lost_bits;

  /// Gives the working memory above, but `far_cells`, the size of the chunk. Throws std::bad_alloc.
  void fit_chunk();
};

/// Sorts the measurements of one frame into voxels and rays.
class EndPoints {
 public:
  /// `window`: around the sensor, covers the range. `far_window`: covers all measurements, for
  /// those beyond the range in mode discretize; null when that would be too large. Both outlive
  /// this.
  EndPoints(double resolution_m,
            const PointF& sensor,
            const IntegrationOptions& options,
            const WindowGeometry& window,
            const WindowGeometry* far_window);

  /// Makes room in a sink for any share of these points, down to none and up to all: which thread
  /// gets how many differs from frame to frame. Throws std::bad_alloc.
  void reserve(EndSink& sink, const MeasuredPoints& points) const;
  /// Takes the points of the sink's chunk; writes the voxel of each (kNoCell when none) to `cells`,
  /// which has the chunk's size. Mode exact: a ray for each. Throws std::bad_alloc.
  void add(EndSink& sink, std::span<std::uint32_t> cells) const;
  /// Mode discretize, when all is added and all sinks are united in this one: one ray for each
  /// voxel. Throws std::bad_alloc.
  void cast_from_voxels(EndSink& sink) const;
  /// Where the ray to a point ends: there, or at the range.
  [[nodiscard]] PointF ray_end(const PointF& point) const noexcept;

 private:
  void mark(EndSink& sink) const;
  void add_rays(EndSink& sink) const;
  void add_far(EndSink& sink) const;
  void drop(EndSink& sink) const;
  /// The point at the range toward `point`.
  [[nodiscard]] PointF shortened(const PointF& point) const noexcept;

  double resolution_m_;
  PointF sensor_;
  IntegrationMode mode_;
  RangeLimit range_;
  const WindowGeometry* window_;
  const WindowGeometry* far_window_;
  kernels::CellGrid grid_;
  kernels::CellGrid far_grid_;
  bool ends_may_leave_volume_;
};

}  // namespace hypermap

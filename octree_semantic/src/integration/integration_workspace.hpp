// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Working memory of an integrator and the steps of one integration.
#pragma once

#include "frame_writer.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "integration/marking/bit_window.hpp"
#include "integration/marking/depth_pyramid.hpp"
#include "integration/marking/end_points.hpp"
#include "integration/marking/free_projection.hpp"
#include "integration/marking/measured_points.hpp"
#include "octree/point_f.hpp"
#include "workers.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// All memory is kept from frame to frame; it is bounded by the window that a frame reaches over.
class IntegrationWorkspace {
 public:
  /// Errors: as FrameIntegrator::integrate, of what was not checked before. `image` are the same
  /// points when they come from a depth image, else null; mode projective needs it.
  [[nodiscard]] Result<IntegrationReport> integrate(SemanticOctree& tree,
                                                    const MeasuredPoints& points,
                                                    const DepthPoints* image,
                                                    std::span<const PixelLabels> labels,
                                                    const IntegrationOptions& options);
  /// As FrameIntegrator::label_boxes.
  [[nodiscard]] std::span<const std::optional<Box>> label_boxes() const noexcept {
    return writer_.label_boxes();
  }

 private:
  /// What one thread needs of its own.
  struct Slot {
    EndSink ends;
    BitLayer passed;  // voxels that rays went through
  };

  void prepare(const IntegrationOptions& options);
  [[nodiscard]] const WindowGeometry* prepare_far(const KeyBox& everything);
  void find_ends(const MeasuredPoints& points, const EndPoints& ends, IntegrationReport& report);
  void cast_rays(double resolution_m, const PointF& sensor);
  void project(const DepthPoints& image,
               const EndPoints& ends,
               double resolution_m,
               double max_range_m);
  [[nodiscard]] std::optional<BrickKey> key_of(std::size_t brick) const noexcept;
  void clear() noexcept;

  [[nodiscard]] BitLayer& hit() noexcept { return slots_.front().ends.hit; }
  [[nodiscard]] BitLayer& passed() noexcept { return slots_.front().passed; }
  [[nodiscard]] std::vector<PointF>& ray_ends() noexcept { return slots_.front().ends.ray_ends; }

  FreeProjection projection_;
  Workers workers_;
  WindowGeometry window_;      // around the sensor
  WindowGeometry far_window_;  // over all measurements
  std::vector<Slot> slots_;    // one per worker; united in the first
  std::vector<std::uint32_t> cell_of_measurement_;
  DepthPyramid pyramid_;
  FrameWriter writer_;
};

}  // namespace hypermap

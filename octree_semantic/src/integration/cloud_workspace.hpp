// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Working memory and steps of the integration of a scan that reaches far.
#pragma once

#include "frame_writer.hpp"
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "integration/marking/end_points.hpp"
#include "integration/marking/sparse_marks.hpp"
#include "octree/point_f.hpp"
#include "workers.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hypermap {

/// All memory is kept from scan to scan.
class CloudWorkspace {
 public:
  /// Errors: as FrameIntegrator::integrate_far_cloud, of what was not checked before.
  [[nodiscard]] Result<IntegrationReport> integrate(SemanticOctree& tree,
                                                    const PointF& sensor,
                                                    std::span<const Eigen::Vector3f> points_in_map,
                                                    std::span<const PixelLabels> labels,
                                                    const CloudOptions& options);
  /// As FrameIntegrator::label_boxes.
  [[nodiscard]] std::span<const std::optional<Box>> label_boxes() const noexcept {
    return writer_.label_boxes();
  }

 private:
  /// What holds for all points of a scan.
  struct Scan {
    const VoxelGrid& grid;
    PointF sensor;
    RangeLimit hit_range;
    RangeLimit free_range;
    std::array<int, 3> sensor_voxel{};  // from the map's origin
  };
  /// False when there are too many bricks.
  [[nodiscard]] bool mark(const Scan& scan,
                          std::span<const Eigen::Vector3f> points,
                          IntegrationMode mode,
                          IntegrationReport& report);
  [[nodiscard]] bool mark_end(const Scan& scan,
                              std::size_t index,
                              const PointF& point,
                              IntegrationMode mode,
                              IntegrationReport& report);
  [[nodiscard]] bool cast_from_voxels(const Scan& scan);
  /// Marks the voxels from the sensor's up to the one before that of the ray's end, which is
  /// `toward` or nearer.
  [[nodiscard]] bool cast(const Scan& scan, const PointF& toward);

  FrameWriter writer_;
  Workers workers_;
  std::vector<std::uint32_t> cell_of_point_;
  SparseMarks marks_;
};

}  // namespace hypermap

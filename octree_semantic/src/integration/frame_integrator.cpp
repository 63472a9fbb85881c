// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include "cloud_workspace.hpp"
#include "frame_checks.hpp"
#include "integration/marking/measured_points.hpp"
#include "integration_workspace.hpp"

namespace hypermap {

struct FrameIntegrator::Workspace {
  IntegrationWorkspace frames;
  CloudWorkspace scans;
  bool last_was_scan = false;
};

FrameIntegrator::FrameIntegrator() : workspace_(std::make_unique<Workspace>()) {}
FrameIntegrator::FrameIntegrator(FrameIntegrator&&) noexcept = default;
FrameIntegrator& FrameIntegrator::operator=(FrameIntegrator&&) noexcept = default;
FrameIntegrator::~FrameIntegrator() = default;

Result<IntegrationReport> FrameIntegrator::integrate(SemanticOctree& tree,
                                                     const RgbdFrame& frame,
                                                     std::span<const PixelLabels> labels,
                                                     const IntegrationOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(validate(frame));
  HYPERMAP_TRY(check_sensor(tree.grid(), frame.map_from_camera.origin(), "map_from_camera"));
  HYPERMAP_TRY(check_labels(labels, frame.depth_m.size()));
  const DepthPoints points(frame);
  workspace_->last_was_scan = false;
  return workspace_->frames.integrate(tree, points, &points, labels, options);
}

Result<IntegrationReport> FrameIntegrator::integrate_cloud(
    SemanticOctree& tree,
    const PointInMap& sensor,
    std::span<const Eigen::Vector3f> points_in_map,
    std::span<const PixelLabels> labels,
    const IntegrationOptions& options) {
  HYPERMAP_TRY(validate(options));
  if (options.mode == IntegrationMode::kProjective) {
    return fail(ErrorCode::kInvalidArgument,
                "a cloud has no image to project into: use exact or discretize",
                "mode");
  }
  HYPERMAP_TRY(check_sensor(tree.grid(), sensor, "sensor"));
  HYPERMAP_TRY(check_labels(labels, points_in_map.size()));
  const CloudPoints points(sensor, points_in_map);
  workspace_->last_was_scan = false;
  return workspace_->frames.integrate(tree, points, nullptr, labels, options);
}

Result<IntegrationReport> FrameIntegrator::integrate_far_cloud(
    SemanticOctree& tree,
    const PointInMap& sensor,
    std::span<const Eigen::Vector3f> points_in_map,
    std::span<const PixelLabels> labels,
    const CloudOptions& options) {
  HYPERMAP_TRY(validate(options));
  HYPERMAP_TRY(check_sensor(tree.grid(), sensor, "sensor"));
  HYPERMAP_TRY(check_labels(labels, points_in_map.size()));
  const Eigen::Vector3f rounded = sensor.xyz.cast<float>();
  workspace_->last_was_scan = true;
  return workspace_->scans.integrate(
      tree, {rounded.x(), rounded.y(), rounded.z()}, points_in_map, labels, options);
}

std::span<const std::optional<Box>> FrameIntegrator::label_boxes() const noexcept {
  return workspace_->last_was_scan ? workspace_->scans.label_boxes()
                                   : workspace_->frames.label_boxes();
}

}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
/// @file
/// Frames and clouds of a few pixels, and what they leave in a map.
#pragma once

#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace hypermap::test {

inline const IntegrationOptions kExact{IntegrationMode::kExact, 5.0, 1};
inline const IntegrationOptions kDiscretize{IntegrationMode::kDiscretize, 5.0, 1};
inline const IntegrationOptions kProjective{IntegrationMode::kProjective, 5.0, 1};

/// A camera of 3 x 3 pixels at `origin` that looks along +x of the map; the middle pixel is 4.
inline RgbdFrame small_frame(const Eigen::Vector3d& origin, float depth_m) {
  RgbdFrame frame;
  frame.camera = {3, 3, 100.0, 100.0, 1.0, 1.0};
  frame.depth_m = DepthImage(3, 3, depth_m);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().col(0) = Eigen::Vector3d(0, -1, 0);
  pose.linear().col(1) = Eigen::Vector3d(0, 0, -1);
  pose.linear().col(2) = Eigen::Vector3d(1, 0, 0);
  pose.translation() = origin;
  frame.map_from_camera = MapFromCamera(pose);
  return frame;
}

inline IntegrationReport integrate_points(SemanticOctree& tree,
                                          const Eigen::Vector3d& sensor,
                                          const std::vector<Eigen::Vector3f>& points,
                                          const IntegrationOptions& options) {
  const auto report = FrameIntegrator().integrate_cloud(tree, {sensor}, points, {}, options);
  EXPECT_TRUE(report) << to_string(report.error());
  return report.value_or(IntegrationReport{});
}

inline std::optional<double> occupancy(const SemanticOctree& tree, const Eigen::Vector3d& point) {
  const auto leaf = tree.at(PointInMap{point});
  return leaf ? std::optional(leaf->occupancy.value()) : std::nullopt;
}

}  // namespace hypermap::test

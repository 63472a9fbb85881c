// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/integration/integration_cases.hpp"
#include "octree_semantic/support/integrate.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace hypermap::test {
namespace {

/// A camera of 90 degrees at the origin that looks along +x, everything `depth_m` away.
RgbdFrame wide_frame(float depth_m) {
  RgbdFrame frame = small_frame({0.05, 0.05, 0.05}, depth_m);
  frame.camera = {64, 64, 32.0, 32.0, 31.5, 31.5};
  frame.depth_m = DepthImage(64, 64, depth_m);
  return frame;
}

TEST(ProjectiveIntegration, ProjectionFreesWhatTheImageLooksThrough) {
  // A wall at x = 2.05: at 1 m the image is 2 m wide and high.
  SemanticOctree tree = empty_tree();
  integrate(tree, wide_frame(2.0F), kProjective);
  EXPECT_EQ(occupancy(tree, {1.05, 0.05, 0.05}), -0.405);
  EXPECT_EQ(occupancy(tree, {1.05, 0.95, -0.85}), -0.405);
  EXPECT_FALSE(occupancy(tree, {1.05, 1.25, 0.05})) << "outside the image";
  EXPECT_FALSE(occupancy(tree, {-0.15, 0.05, 0.05})) << "behind the camera";
  EXPECT_EQ(occupancy(tree, {2.05, 0.05, 0.05}), 0.847);
  EXPECT_FALSE(occupancy(tree, {2.25, 0.05, 0.05})) << "behind the wall";
}

TEST(ProjectiveIntegration, PixelsWithoutDepthFreeNothing) {
  for (const float nothing : {0.0F,
                              -1.0F,
                              std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity(),
                              1e30F}) {
    SemanticOctree tree = empty_tree();
    RgbdFrame frame = wide_frame(2.0F);
    for (int v = 0; v < 64; ++v) {
      for (int u = 0; u < 32; ++u) frame.depth_m.at(u, v) = nothing;  // the side of +y
    }
    integrate(tree, frame, kProjective);
    EXPECT_EQ(occupancy(tree, {1.05, -0.45, 0.05}), -0.405);
    EXPECT_FALSE(occupancy(tree, {1.05, 0.45, 0.05})) << nothing;
    EXPECT_FALSE(occupancy(tree, {2.05, 0.45, 0.05})) << nothing;
  }
}

TEST(ProjectiveIntegration, AHitWinsOverProjection) {
  // A thin object at 1 m before a wall at 2 m: its voxel is seen past on both sides.
  SemanticOctree tree = empty_tree();
  RgbdFrame frame = wide_frame(2.0F);
  for (int v = 0; v < 64; ++v) frame.depth_m.at(32, v) = 1.0F;
  integrate(tree, frame, kProjective);
  EXPECT_EQ(occupancy(tree, {1.05, 0.03, 0.05}), 0.847);
  EXPECT_EQ(occupancy(tree, {1.05, 0.25, 0.05}), -0.405);
}

TEST(ProjectiveIntegration, SparsePixelsFreeTheirRays) {
  // One pixel in a tile: hardly a corner falls in it, so its ray is cast.
  SemanticOctree tree = empty_tree();
  RgbdFrame frame = wide_frame(0.0F);
  frame.depth_m.at(21, 37) = 2.0F;
  integrate(tree, frame, kProjective);
  SemanticOctree exact = empty_tree();
  integrate(exact, frame, kExact);
  EXPECT_GT(exact.num_leaves().free, 15U);
  exact.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    const auto ours = tree.stored_at(leaf.key);
    EXPECT_TRUE(ours && ours->log_odds == leaf.log_odds);
  });
}

TEST(ProjectiveIntegration, ACloudHasNoImageToProjectInto) {
  SemanticOctree tree = empty_tree();
  const auto report = FrameIntegrator().integrate_cloud(
      tree, {{0, 0, 0}}, std::vector{Eigen::Vector3f(1, 0, 0)}, {}, kProjective);
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().field, "mode");
  EXPECT_TRUE(tree.empty());
}

}  // namespace
}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"

#include "octree_semantic/integration/integration_cases.hpp"
#include "octree_semantic/support/integrate.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hypermap::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
TEST(FrameIntegrator, AWallIsHitAndTheWayToItIsFree) {
  for (const IntegrationMode mode : kAllModes) {
    SemanticOctree tree = empty_tree();
    const IntegrationReport report =
        integrate(tree, small_frame({0.05, 0.05, 0.05}, 1.0F), {mode, 5.0, 1});
    EXPECT_EQ(report.num_hits, 9U);
    EXPECT_EQ(report.num_occupied_voxels, 1U);  // rays spread by 1 cm over 1 m
    EXPECT_EQ(report.num_free_voxels, 10U);
    EXPECT_EQ(occupancy(tree, {1.05, 0.05, 0.05}), 0.847);
    for (int i = 0; i < 10; ++i) {
      EXPECT_EQ(occupancy(tree, {0.05 + 0.1 * i, 0.05, 0.05}), -0.405) << i;
    }
    EXPECT_FALSE(occupancy(tree, {1.15, 0.05, 0.05}));
  }
}

TEST(FrameIntegrator, AHitWinsOverRaysThatPassInTheSameFrame) {
  SemanticOctree tree = empty_tree();
  // The second point lies behind the first.
  integrate_points(
      tree, {0.05, 0.05, 0.05}, {{1.05F, 0.05F, 0.05F}, {2.05F, 0.05F, 0.05F}}, kExact);
  EXPECT_EQ(occupancy(tree, {1.05, 0.05, 0.05}), 0.847);
  EXPECT_EQ(occupancy(tree, {1.55, 0.05, 0.05}), -0.405);
  EXPECT_EQ(occupancy(tree, {2.05, 0.05, 0.05}), 0.847);
}

TEST(FrameIntegrator, LogOddsAddUpAndAreClamped) {
  // OctoMap, Eq. (4): 5 x 0.847 = 4.235, clamped to 3.511; 5 x -0.405 = -2.025, clamped to -2.
  const RgbdFrame frame = small_frame({0.05, 0.05, 0.05}, 1.0F);
  for (const IntegrationMode mode : kAllModes) {
    SemanticOctree tree = empty_tree();
    for (int i = 1; i <= 5; ++i) {
      integrate(tree, frame, {mode, 5.0, 1});
      EXPECT_NEAR(*occupancy(tree, {1.05, 0.05, 0.05}), std::min(0.847 * i, 3.511), 1e-9);
      EXPECT_NEAR(*occupancy(tree, {0.55, 0.05, 0.05}), std::max(-0.405 * i, -2.0), 1e-9);
    }
  }
}

TEST(FrameIntegrator, MeasurementsBeyondTheRangeClearUpToItAndOccupyNothing) {
  for (const IntegrationMode mode : kAllModes) {
    SemanticOctree tree = empty_tree();
    const IntegrationReport report =
        integrate(tree, small_frame({0.05, 0.05, 0.05}, 4.0F), {mode, 2.0, 1});
    EXPECT_EQ(report.num_beyond_range, 9U);
    EXPECT_EQ(report.num_hits + report.num_occupied_voxels, 0U);
    EXPECT_EQ(occupancy(tree, {1.95, 0.05, 0.05}), -0.405);
    EXPECT_FALSE(occupancy(tree, {2.15, 0.05, 0.05}));
    EXPECT_EQ(tree.num_leaves().occupied, 0U);
  }
}

TEST(FrameIntegrator, WhatIsNoMeasurementIsCountedByReason) {
  for (const IntegrationOptions& options : {kExact, kDiscretize, kProjective}) {
    SemanticOctree tree = empty_tree();
    RgbdFrame frame = small_frame({0.05, 0.05, 0.05}, 0.0F);
    frame.depth_m.pixels()[1] = -0.0F;
    frame.depth_m.pixels()[2] = -1.0F;
    frame.depth_m.pixels()[3] = std::numeric_limits<float>::quiet_NaN();
    frame.depth_m.pixels()[4] = std::numeric_limits<float>::infinity();
    frame.depth_m.pixels()[5] = -std::numeric_limits<float>::infinity();
    frame.depth_m.pixels()[6] = 1e30F;
    frame.depth_m.pixels()[7] = std::numeric_limits<float>::denorm_min();
    frame.depth_m.pixels()[8] = 1.0F;
    const IntegrationReport report = integrate(tree, frame, options);
    EXPECT_EQ(report.num_not_measured, 3U);
    EXPECT_EQ(report.num_not_finite, 3U);
    EXPECT_EQ(report.num_outside_volume, 1U) << "1e30: its square is infinite";
    EXPECT_EQ(report.num_hits, 2U) << "a denormal depth ends at the camera";
    EXPECT_EQ(tree.num_leaves().occupied, 2U);
  }
}

TEST(FrameIntegrator, AnEmptyFrameChangesNothing) {
  SemanticOctree tree = empty_tree();
  const IntegrationReport report = integrate(tree, small_frame({0, 0, 0}, 0.0F), kDiscretize);
  EXPECT_EQ(report.num_not_measured, 9U);
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(integrate_points(tree, {0, 0, 0}, {}, kExact), IntegrationReport{});
}

TEST(FrameIntegrator, PointsOutsideTheVolumeAreDroppedAndNeverWrapped) {
  // At 1 mm the volume ends at 32.768 m.
  for (const IntegrationMode mode : {IntegrationMode::kExact, IntegrationMode::kDiscretize}) {
    SemanticOctree tree = empty_tree(0.001);
    const IntegrationReport report = integrate_points(
        tree, {32.7, 0.0, 0.0}, {{32.76F, 0.0F, 0.0F}, {32.8F, 0.0F, 0.0F}}, {mode, 1.0, 1});
    EXPECT_EQ(report.num_hits, 1U);
    EXPECT_EQ(report.num_outside_volume, 1U);
    EXPECT_EQ(tree.num_leaves().occupied, 1U);
    tree.for_each_leaf([](const LeafSample& leaf) {
      EXPECT_GT(leaf.centre_in_map.x(), 32.6);
      EXPECT_LT(leaf.centre_in_map.x(), 32.768);
    });
  }
}

TEST(FrameIntegrator, TheLastVoxelsOfTheVolumeAreUsable) {
  SemanticOctree tree = empty_tree(0.001);
  const std::vector<Eigen::Vector3f> corners{{-32.7679F, -32.7679F, -32.7679F}};
  integrate_points(tree, {-32.75, -32.75, -32.75}, corners, kExact);
  EXPECT_TRUE(tree.at(VoxelKey{0, 0, 0})->occupied);
}

TEST(FrameIntegrator, AFrameFromOutsideTheVolumeIsRefusedWhole) {
  SemanticOctree tree = empty_tree(0.001);
  for (const Eigen::Vector3d& origin : {Eigen::Vector3d(33.0, 0, 0), Eigen::Vector3d(0, 0, -1e9)}) {
    const auto report =
        FrameIntegrator().integrate(tree, small_frame(origin, 1.0F), {}, kDiscretize);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().code, ErrorCode::kInvalidArgument);
    EXPECT_TRUE(tree.empty());
  }
  EXPECT_FALSE(FrameIntegrator().integrate_cloud(tree, {{kNan, 0, 0}}, {}, {}, kExact));
}

TEST(FrameIntegrator, RefusesImpossibleOptionsAndLabels) {
  SemanticOctree tree = empty_tree();
  const RgbdFrame frame = small_frame({0, 0, 0}, 1.0F);
  FrameIntegrator integrator;
  const auto field_of = [&](const IntegrationOptions& options, const PixelLabels& label) {
    const auto report = integrator.integrate(tree, frame, std::vector{label}, options);
    return report ? std::string("none") : report.error().field;
  };
  EXPECT_EQ(field_of({IntegrationMode::kExact, 0.0, 1}, {}), "max_range_m");
  EXPECT_EQ(field_of({IntegrationMode::kExact, kNan, 1}, {}), "max_range_m");
  EXPECT_EQ(field_of({IntegrationMode::kExact, kInfinity, 1}, {}), "max_range_m");
  EXPECT_EQ(field_of({IntegrationMode::kExact, 1.0, 0}, {}), "num_threads");
  EXPECT_EQ(field_of(kExact, {.pixel_indices = {9}}), "pixel_indices");
  const ClassEvidence beyond{ClassId{65535}, Probability(1.0)};
  EXPECT_EQ(field_of(kExact, {.class_scores = {beyond}}), "class_scores");
  const ClassEvidence some{ClassId{3}, Probability(0.5)};
  EXPECT_EQ(field_of(kExact, {.class_scores = {some, some}}), "class_scores");
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(field_of(kExact, {}), "none");
}

TEST(FrameIntegrator, RefusesARangeThatTakesTooMuchMemory) {
  SemanticOctree tree = empty_tree(0.001);
  std::vector<Eigen::Vector3f> points;
  for (const float at : {-20.0F, 20.0F}) points.push_back(Eigen::Vector3f::Constant(at));
  const auto report = FrameIntegrator().integrate_cloud(
      tree, {{0, 0, 0}}, points, {}, {IntegrationMode::kExact, 100.0, 1});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().code, ErrorCode::kLimit);
  EXPECT_TRUE(tree.empty());
}

TEST(FrameIntegrator, ARefusedFrameLeavesTheMapAsItWas) {
  SemanticOctree tree = empty_tree();
  FrameIntegrator integrator;
  integrate(tree, small_frame({0, 0, 0}, 1.0F), kDiscretize);
  const SemanticOctree before = tree;
  EXPECT_FALSE(integrator.integrate(
      tree, small_frame({0, 0, 0}, 2.0F), std::vector{PixelLabels{.pixel_indices = {77}}}, kExact));
  EXPECT_EQ(tree, before);
}

TEST(FrameIntegrator, TheCameraMayStandInAnOccupiedVoxel) {
  for (const IntegrationMode mode : kAllModes) {
    SemanticOctree tree = empty_tree();
    const RgbdFrame frame = small_frame({0.05, 0.05, 0.05}, 1.0F);
    ASSERT_TRUE(tree.set_leaf({.key = {32768, 32768, 32768}, .log_odds = 3511}));
    integrate(tree, frame, {mode, 5.0, 1});
    EXPECT_NEAR(*occupancy(tree, {0.05, 0.05, 0.05}), 3.511 - 0.405, 1e-9);
  }
}

TEST(FrameIntegrator, AZeroLengthRayIsAHitWhereTheSensorIs) {
  for (const IntegrationOptions& options : {kExact, kDiscretize}) {
    SemanticOctree tree = empty_tree();
    integrate_points(
        tree, {0.03, 0.03, 0.03}, {{0.03F, 0.03F, 0.03F}, {0.07F, 0.01F, 0.09F}}, options);
    EXPECT_EQ(tree.num_leaves(), (LeafCount{1, 0}));
    EXPECT_EQ(occupancy(tree, {0.05, 0.05, 0.05}), 0.847);
  }
}

TEST(FrameIntegrator, RaysRunAlongAxesAndDiagonalsAndOnFaces) {
  // 26 directions from a corner shared by eight voxels, where every tie occurs.
  for (const Eigen::Vector3d& sensor :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d::Constant(0.05).eval()}) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          SemanticOctree tree = empty_tree();
          const Eigen::Vector3d end = sensor + Eigen::Vector3d(x, y, z);
          integrate_points(tree, sensor, {end.cast<float>()}, kExact);
          EXPECT_EQ(tree.num_leaves().occupied, 1U);
          // OctoMap's arithmetic may end a ray on the face before its last voxel.
          EXPECT_GE(tree.num_leaves().free, 9U);
          EXPECT_EQ(occupancy(tree, end.cast<float>().cast<double>()), 0.847);
          EXPECT_EQ(occupancy(tree, sensor), -0.405);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hypermap::test

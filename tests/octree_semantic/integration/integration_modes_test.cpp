// SPDX-License-Identifier: BSD-3-Clause
// What holds for every mode of integration.
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/support/integrate.hpp"
#include "octree_semantic/support/labelled_frame.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

namespace hypermap::test {
namespace {

class IntegrationModes : public ::testing::TestWithParam<IntegrationMode> {};
INSTANTIATE_TEST_SUITE_P(All, IntegrationModes, ::testing::ValuesIn(kAllModes));

TEST_P(IntegrationModes, AnyNumberOfThreadsGivesTheSameMap) {
  const std::vector<LabelledFrame> frames = room_frames(4, 160);
  std::vector<SemanticOctree> trees;
  std::vector<IntegrationReport> reports;
  for (const int num_threads : {1, 2, 3, 7}) {
    SemanticOctree tree = empty_tree(0.05);
    FrameIntegrator integrator;
    for (const LabelledFrame& labelled : frames) {
      reports.push_back(
          integrator
              .integrate(tree, labelled.frame, labelled.labels, {GetParam(), 3.5, num_threads})
              .value());
    }
    trees.push_back(tree);
  }
  EXPECT_EQ(trees[0], trees[1]);
  EXPECT_EQ(trees[0], trees[2]);
  EXPECT_EQ(trees[0], trees[3]);
  for (std::size_t i = 4; i < reports.size(); ++i) EXPECT_EQ(reports[i], reports[i - 4]);
}

TEST_P(IntegrationModes, TheOrderOfMeasurementsDoesNotMatter) {
  if (GetParam() == IntegrationMode::kProjective) return;  // an image has one order
  const std::vector<LabelledFrame> frames = room_frames(2, 80);
  SemanticOctree in_order = empty_tree(0.05);
  SemanticOctree shuffled = empty_tree(0.05);
  std::mt19937 random(3);
  for (const LabelledFrame& labelled : frames) {
    const RgbdFrame& frame = labelled.frame;
    std::vector<Eigen::Vector3f> points = measured_points(frame);
    std::vector<std::uint32_t> place(points.size());
    for (std::uint32_t i = 0; i < place.size(); ++i) place[i] = i;
    std::shuffle(place.begin(), place.end(), random);
    std::vector<Eigen::Vector3f> moved(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) moved[place[i]] = points[i];
    std::vector<PixelLabels> labels{{ObjectId{1}, class_vector(ClassId{0}, 0.6, 5), {}},
                                    {ObjectId{2}, class_vector(ClassId{1}, 0.6, 5), {}}};
    std::vector<PixelLabels> moved_labels = labels;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      labels[i % 2].pixel_indices.push_back(i);
      moved_labels[i % 2].pixel_indices.push_back(place[i]);
    }
    const IntegrationOptions options{GetParam(), 3.5, 1};
    const PointInMap sensor = frame.map_from_camera.origin();
    FrameIntegrator integrator;
    ASSERT_TRUE(integrator.integrate_cloud(in_order, sensor, points, labels, options));
    ASSERT_TRUE(integrator.integrate_cloud(shuffled, sensor, moved, moved_labels, options));
  }
  EXPECT_EQ(in_order, shuffled);
}

TEST_P(IntegrationModes, AReusedIntegratorWorksAsAFreshOne) {
  const std::vector<LabelledFrame> frames = room_frames(4, 80);
  SemanticOctree reused = empty_tree(0.05);
  SemanticOctree fresh = empty_tree(0.05);
  FrameIntegrator integrator;
  for (const LabelledFrame& labelled : frames) {
    const IntegrationOptions options{GetParam(), 4.0, 1};
    ASSERT_TRUE(integrator.integrate(reused, labelled.frame, labelled.labels, options));
    SemanticOctree other = empty_tree(0.2);  // another window in between
    ASSERT_TRUE(integrator.integrate(other, labelled.frame, {}, {GetParam(), 1.0, 2}));
    ASSERT_TRUE(FrameIntegrator().integrate(fresh, labelled.frame, labelled.labels, options));
  }
  EXPECT_EQ(reused, fresh);
}

TEST_P(IntegrationModes, FreeSpaceSeenOftenIsSharedAndStaysWhatItIs) {
  // Once every voxel of a brick is clamped, further frames neither change nor copy it.
  const LabelledFrame labelled = room_frames(1, 160).front();
  SemanticOctree tree = empty_tree(0.02);
  const auto again = [&] { return integrate(tree, labelled.frame, {GetParam(), 3.0, 1}); };
  const IntegrationReport first = again();
  const std::size_t bytes_once = tree.memory_bytes();
  for (int i = 0; i < 10; ++i) again();
  EXPECT_LT(tree.memory_bytes(), bytes_once * 19 / 20);
  const SemanticOctree before = tree;
  const IntegrationReport last = again();
  EXPECT_EQ(last.num_free_voxels, first.num_free_voxels);
  EXPECT_EQ(tree, before);
  std::vector<StoredLeaf> leaves;
  tree.for_each_stored_leaf([&](const StoredLeaf& leaf) { leaves.push_back(leaf); });
  EXPECT_EQ(SemanticOctree::from_leaves(tree.options(), leaves).value(), tree);
}

TEST_P(IntegrationModes, EveryMeasurementIsCountedOnce) {
  const LabelledFrame labelled = room_frames(1, 160).front();
  SemanticOctree tree = empty_tree(0.05);
  const IntegrationReport report =
      integrate(tree, labelled.frame, {GetParam(), 3.0, 1}, labelled.labels);
  EXPECT_EQ(report.num_hits + report.num_beyond_range + report.num_not_measured +
                report.num_not_finite + report.num_outside_volume,
            labelled.frame.depth_m.size());
  EXPECT_GT(report.num_beyond_range, 0U);
  const LeafCount leaves = tree.num_leaves();
  EXPECT_EQ(report.num_occupied_voxels, leaves.occupied);
  EXPECT_EQ(report.num_free_voxels, leaves.free);
}

}  // namespace
}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
// Scans that reach far: against the dense integration, and against OctoMap's rays one by one.
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/support/integrate.hpp"
#include "octree_semantic/support/labelled_frame.hpp"
#include "support/sanitized.hpp"

#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

namespace hypermap::test {
namespace {

using Points = std::vector<Eigen::Vector3f>;

/// Points in all directions, at distances from 0 to `max_m`.
Points scattered(std::size_t num_points, double max_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::uniform_real_distribution<double> distance(0.0, max_m);
  Points points;
  while (points.size() < num_points) {
    const Eigen::Vector3d way(unit(random), unit(random), 0.3 * unit(random));
    points.emplace_back((way.normalized() * distance(random)).cast<float>());
  }
  return points;
}

IntegrationReport integrate_far(SemanticOctree& tree,
                                const Points& points,
                                const CloudOptions& options,
                                const std::vector<PixelLabels>& labels = {}) {
  const auto report =
      FrameIntegrator().integrate_far_cloud(tree, {{0.01, 0.02, 0.03}}, points, labels, options);
  EXPECT_TRUE(report) << to_string(report.error());
  return report.value_or(IntegrationReport{});
}

class FarCloudModes : public ::testing::TestWithParam<IntegrationMode> {};
INSTANTIATE_TEST_SUITE_P(All,
                         FarCloudModes,
                         ::testing::Values(IntegrationMode::kExact, IntegrationMode::kDiscretize));

TEST_P(FarCloudModes, WithOneRangeTheVoxelsAreThoseOfTheDenseIntegration) {
  // Some points beyond the range, some not finite, some outside the volume (3,276.8 m), some
  // labelled.
  Points points = scattered(repetitions(3000), 8.0, 1);
  points[5].x() = std::numeric_limits<float>::quiet_NaN();
  if (GetParam() == IntegrationMode::kExact) {
    // In mode discretize the dense window over all of them would be too large to unite voxels.
    points[6] = {4000.0F, 0.0F, 0.0F};
    points[7] = {1e30F, 0.0F, 0.0F};
  }
  std::vector<PixelLabels> labels(2);
  labels[0] = {.object = ObjectId{7}, .class_scores = class_vector(ClassId{1}, 0.8, 4)};
  labels[1] = {.object = kNoObject, .class_scores = class_vector(ClassId{2}, 0.6, 4)};
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (i % 3 < 2) labels[i % 3].pixel_indices.push_back(i);
  }
  SemanticOctree dense = empty_tree(0.1);
  SemanticOctree sparse = empty_tree(0.1);
  for (int scan = 0; scan < 3; ++scan) {
    const auto expected = FrameIntegrator().integrate_cloud(
        dense, {{0.01, 0.02, 0.03}}, points, labels, IntegrationOptions{GetParam(), 6.0, 1});
    IntegrationReport report = integrate_far(
        sparse,
        points,
        {.mode = GetParam(), .max_range_m = 6.0, .free_range_m = 6.0, .max_memory_mb = 512},
        labels);
    EXPECT_GT(report.working_bytes, 0U);
    report.working_bytes = 0;
    // Discretize: the dense one makes blank bricks where no centre is within the range.
    EXPECT_LE(report.num_new_bricks, expected->num_new_bricks);
    report.num_new_bricks = expected->num_new_bricks;
    EXPECT_EQ(report, *expected);
  }
  EXPECT_TRUE(sparse == dense);
  EXPECT_GT(sparse.num_leaves().free, 1000U);
}

using Keys = std::set<VoxelKey>;

VoxelKey ours(const octomap::OcTreeKey& key) {
  return {key[0], key[1], key[2]};
}

/// What OctoMap says of one scan: end voxels within `max_range_m`, and what the rays to them, cut
/// at `free_range_m`, pass.
void brute_force(const Points& points, const CloudOptions& options, Keys& occupied, Keys& free) {
  octomap::OcTree tree(0.1);
  const octomap::point3d sensor(0.01F, 0.02F, 0.03F);
  octomap::KeyRay ray;
  Points ends = points;
  if (options.mode == IntegrationMode::kDiscretize) {
    Keys voxels;
    for (const Eigen::Vector3f& p : points) {
      voxels.insert(ours(tree.coordToKey(octomap::point3d(p.x(), p.y(), p.z()))));
    }
    ends.clear();
    for (const VoxelKey& key : voxels) {
      const auto centre = tree.keyToCoord(octomap::OcTreeKey(key.x, key.y, key.z));
      ends.emplace_back(centre.x(), centre.y(), centre.z());
    }
  }
  for (const Eigen::Vector3f& p : ends) {
    octomap::point3d end(p.x(), p.y(), p.z());
    const double distance = (end - sensor).norm();
    if (distance <= options.max_range_m) occupied.insert(ours(tree.coordToKey(end)));
    if (distance > options.free_range_m) {
      end = sensor + (end - sensor).normalized() * static_cast<float>(options.free_range_m);
    }
    if (!tree.computeRayKeys(sensor, end, ray)) continue;
    for (const octomap::OcTreeKey& key : ray) free.insert(ours(key));
  }
  for (const VoxelKey& key : occupied) free.erase(key);
}

TEST_P(FarCloudModes, OccupiesFarAndFreesNear) {
  const Points points = scattered(repetitions(2000), 120.0, 2);
  const CloudOptions options{.mode = GetParam(), .max_range_m = 100.0, .free_range_m = 15.0};
  SemanticOctree tree = empty_tree(0.1);
  const IntegrationReport report = integrate_far(tree, points, options);
  EXPECT_EQ(report.num_hits + report.num_beyond_range, points.size());
  EXPECT_GT(report.num_beyond_range, 0U);
  Keys occupied;
  Keys free;
  brute_force(points, options, occupied, free);
  Keys our_occupied;
  Keys our_free;
  tree.for_each_stored_leaf([&](const StoredLeaf& leaf) {
    (leaf.log_odds > 0 ? our_occupied : our_free).insert(leaf.key);
  });
  EXPECT_TRUE(our_occupied == occupied);
  EXPECT_TRUE(our_free == free);
  EXPECT_GT(free.size(), occupied.size());
}

TEST(FarCloud, AScanThatNeedsMoreMemoryIsRefusedWhole) {
  SemanticOctree tree = empty_tree(0.05);
  FrameIntegrator integrator;
  const Points points = scattered(20'000, 100.0, 3);
  CloudOptions options{.max_memory_mb = 1};
  const auto refused = integrator.integrate_far_cloud(tree, {{0, 0, 0}}, points, {}, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kLimit);
  EXPECT_EQ(refused.error().field, "max_memory_mb");
  EXPECT_EQ(refused.error().what, "the scan needs 2 MiB or more to work on, of 1 that are allowed");
  EXPECT_TRUE(tree.empty());
  options.max_memory_mb = 512;
  const auto taken = integrator.integrate_far_cloud(tree, {{0, 0, 0}}, points, {}, options);
  ASSERT_TRUE(taken);
  EXPECT_LE(taken->working_bytes, std::size_t{512} << 20U);
  EXPECT_GT(taken->working_bytes, std::size_t{1} << 20U);
  options.max_memory_mb = 1;
  EXPECT_FALSE(integrator.integrate_far_cloud(tree, {{0, 0, 0}}, points, {}, options))
      << "memory that is there already makes no difference";
}

TEST(FarCloud, MemoryFollowsTheBricksAndNotTheBoxAroundThem) {
  // Eight points 170 m apart: a window around them would have 2^36 bits at 5 cm.
  Points points;
  for (int i = 0; i < 8; ++i) {
    points.emplace_back((i & 1) != 0 ? 50.0F : -50.0F,
                        (i & 2) != 0 ? 50.0F : -50.0F,
                        (i & 4) != 0 ? 50.0F : -50.0F);
  }
  SemanticOctree tree = empty_tree(0.05);
  const IntegrationReport report = integrate_far(tree, points, {});
  EXPECT_EQ(report.num_occupied_voxels, 8U);
  EXPECT_LT(report.working_bytes, std::size_t{1} << 20U);
}

TEST(FarCloud, LabelsAreBoxedByTheBricksThatTheyReach) {
  SemanticOctree tree = empty_tree(0.1);
  FrameIntegrator integrator;
  const Points points{{2.05F, 0.05F, 0.05F}, {3.05F, 0.05F, 0.05F}, {500.0F, 0.0F, 0.0F}};
  std::vector<PixelLabels> labels(2);
  labels[0] = {.object = ObjectId{1}, .class_scores = {}, .pixel_indices = {0, 1}};
  labels[1] = {.object = ObjectId{2}, .class_scores = {}, .pixel_indices = {2}};
  ASSERT_TRUE(integrator.integrate_far_cloud(tree, {{0, 0, 0}}, points, labels, CloudOptions{}));
  const auto boxes = integrator.label_boxes();
  ASSERT_EQ(boxes.size(), 2U);
  ASSERT_TRUE(boxes[0]);
  // Bricks of 0.8 m: from 1.6 to 3.2.
  EXPECT_NEAR(boxes[0]->min_in_map.x(), 1.6, 1e-9);
  EXPECT_NEAR(boxes[0]->max_in_map.x(), 3.2, 1e-9);
  EXPECT_NEAR(boxes[0]->max_in_map.z(), 0.8, 1e-9);
  EXPECT_FALSE(boxes[1]) << "beyond the range";
}

TEST(CloudOptions, NamesTheFieldThatIsWrong) {
  const auto field = [](const CloudOptions& options) { return validate(options).error().field; };
  EXPECT_TRUE(validate(CloudOptions{}));
  EXPECT_EQ(field({.mode = IntegrationMode::kProjective}), "mode");
  EXPECT_EQ(field({.max_range_m = 0.0}), "max_range_m");
  EXPECT_EQ(field({.max_range_m = 10.0, .free_range_m = 10.1}), "free_range_m");
  EXPECT_EQ(field({.max_memory_mb = 0}), "max_memory_mb");
}

}  // namespace
}  // namespace hypermap::test

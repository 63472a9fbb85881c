// SPDX-License-Identifier: BSD-3-Clause
// The occupancy of our integrator against OctoMap's on the same points.
#include "hypermap/octree_semantic/integration/frame_integrator.hpp"
#include "octree_semantic/support/labelled_frame.hpp"
#include "octree_semantic/support/octomap_oracle.hpp"
#include "support/sanitized.hpp"
#include "support/test_data.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace hypermap::test {
namespace {

/// A frame adds at most 0.0005 of rounding (0.847298 -> 0.847, -0.405465 -> -0.405).
constexpr double kRoundingPerFrame = 0.0005;

Agreement map_both(const std::vector<LabelledFrame>& frames,
                   double resolution_m,
                   double max_range_m,
                   IntegrationMode mode) {
  auto ours = SemanticOctree::create({.resolution_m = resolution_m}).value();
  octomap::OcTree theirs(resolution_m);
  FrameIntegrator integrator;
  for (const LabelledFrame& labelled : frames) {
    const auto report =
        integrator.integrate(ours,
                             labelled.frame,
                             labelled.labels,
                             {.mode = mode, .max_range_m = max_range_m, .num_threads = 1});
    EXPECT_TRUE(report);
    insert_frame(theirs, labelled.frame, max_range_m, mode == IntegrationMode::kDiscretize);
  }
  const Agreement agreement =
      compare(ours, theirs, kRoundingPerFrame * static_cast<double>(frames.size()));
  const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
  std::printf(
      "%s, %zu frames at %g m: occupied IoU %.6f (%zu of %zu), free IoU %.6f, differing: "
      "%zu by rounding of the log-odds, %zu otherwise; known to OctoMap only %zu, to us "
      "only %zu; largest difference of log-odds %.4f\n",
      test->name(),
      frames.size(),
      resolution_m,
      agreement.occupied_iou(),
      agreement.both_occupied,
      agreement.either_occupied,
      agreement.free_iou(),
      agreement.by_rounding,
      agreement.otherwise,
      agreement.only_theirs_known,
      agreement.only_ours_known,
      agreement.largest_difference);
  return agreement;
}

/// Twenty frames spread over the recorded kitchen, or as many of its 200 as HYPERMAP_KITCHEN_FRAMES
/// says.
std::vector<LabelledFrame> kitchen() {
  constexpr std::size_t kNumRecorded = 200;
  const char* wanted = std::getenv("HYPERMAP_KITCHEN_FRAMES");
  const std::size_t num_frames =
      wanted == nullptr ? repetitions(std::size_t{20}) : std::strtoul(wanted, nullptr, 10);
  return kitchen_frames(kNumRecorded / std::clamp<std::size_t>(num_frames, 1, kNumRecorded),
                        num_frames);
}

/// OctoMap, compiled here, has ten times the voxels of five centimetres to go through; a sanitizer
/// sees the same code at those.
constexpr const char* kAsAtFive = "a sanitizer sees the same at five centimetres";

/// Both know the same voxels, and what differs in occupancy is explained by log-odds of 16 bits.
void expect_same_voxels(const Agreement& agreement) {
  EXPECT_GE(agreement.occupied_iou(), 0.999);
  EXPECT_EQ(agreement.only_ours_known, 0U);
  EXPECT_EQ(agreement.only_theirs_known, 0U);
  EXPECT_EQ(agreement.otherwise, 0U);
}

TEST(OctomapAgreement, ExactModeKnowsTheSameVoxelsInTheRoom) {
  expect_same_voxels(
      map_both(room_frames(repetitions(8), 320), 0.05, 5.0, IntegrationMode::kExact));
}

TEST(OctomapAgreement, ExactModeKnowsTheSameVoxelsInTheRoomAtTwoCentimetres) {
  if (kSanitized) GTEST_SKIP() << kAsAtFive;
  expect_same_voxels(
      map_both(room_frames(repetitions(4), 320), 0.02, 5.0, IntegrationMode::kExact));
}

TEST(OctomapAgreement, ExactModeClearsUpToTheRangeOnly) {
  expect_same_voxels(
      map_both(room_frames(repetitions(6), 160), 0.05, 2.5, IntegrationMode::kExact));
}

TEST(OctomapAgreement, DiscretizeModeIsThatOfOctomapsRule) {
  expect_same_voxels(
      map_both(room_frames(repetitions(8), 320), 0.05, 20.0, IntegrationMode::kDiscretize));
}

TEST(OctomapAgreement, DiscretizeModeIsThatOfOctomapsRuleBeyondTheRangeToo) {
  expect_same_voxels(
      map_both(room_frames(repetitions(8), 320), 0.05, 3.0, IntegrationMode::kDiscretize));
}

TEST(OctomapAgreement, ExactModeKnowsTheSameVoxelsInTheRealKitchen) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/7scenes_redkitchen");
  expect_same_voxels(map_both(kitchen(), 0.05, 5.0, IntegrationMode::kExact));
}

TEST(OctomapAgreement, DiscretizeModeIsThatOfOctomapInTheRealKitchen) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/7scenes_redkitchen");
  expect_same_voxels(map_both(kitchen(), 0.05, 5.0, IntegrationMode::kDiscretize));
}

// Mode projective keeps nearly the voxels of insertPointCloud: what it looks through by the corners
// of voxels is what rays pass, up to voxels that rays only clip.

TEST(OctomapAgreement, ProjectiveModeKeepsTheOccupiedVoxelsOfTheRoom) {
  EXPECT_GE(map_both(room_frames(repetitions(8), 640), 0.05, 5.0, IntegrationMode::kProjective)
                .occupied_iou(),
            0.99);
}

TEST(OctomapAgreement, ProjectiveModeKeepsTheOccupiedVoxelsOfTheRoomAtTwoCentimetres) {
  if (kSanitized) GTEST_SKIP() << kAsAtFive;
  EXPECT_GE(map_both(room_frames(repetitions(3), 640), 0.02, 5.0, IntegrationMode::kProjective)
                .occupied_iou(),
            0.99);
}

TEST(OctomapAgreement, ProjectiveModeClearsUpToTheRangeOnly) {
  const Agreement agreement =
      map_both(room_frames(repetitions(6), 320), 0.05, 2.5, IntegrationMode::kProjective);
  EXPECT_GE(agreement.occupied_iou(), 0.99);
  EXPECT_GE(agreement.free_iou(), 0.95);
}

TEST(OctomapAgreement, ProjectiveModeKeepsTheOccupiedVoxelsOfTheRealKitchen) {
  HYPERMAP_REQUIRE_SHARED_DATA("rgbd/7scenes_redkitchen");
  const Agreement agreement = map_both(kitchen(), 0.05, 5.0, IntegrationMode::kProjective);
  EXPECT_GE(agreement.occupied_iou(), 0.97);
}

}  // namespace
}  // namespace hypermap::test

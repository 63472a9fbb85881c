// SPDX-License-Identifier: BSD-3-Clause
// What is left of an occlusion scene when Embree fails.
#include "hypermap/octree_semantic/occlusion/occlusion_scene.hpp"
#include "support/sanitized.hpp"

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#if HYPERMAP_ADDRESS_SANITIZER
#include <sanitizer/lsan_interface.h>
#endif

namespace {

/// Whether the next question for Embree's error is answered with one.
bool& fails_next() {
  static bool fails = false;
  return fails;
}

}  // namespace

// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C" {
RTCError __real_rtcGetDeviceError(RTCDevice device);
RTCError __wrap_rtcGetDeviceError(RTCDevice device);
RTCError __wrap_rtcGetDeviceError(RTCDevice device) {
  if (std::exchange(fails_next(), false)) return RTC_ERROR_OUT_OF_MEMORY;
  return __real_rtcGetDeviceError(device);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)

namespace hypermap {
namespace {

const OcclusionRay kAcross{.from = {{-1.0, 0.05, 0.05}}, .to = {{1.0, 0.05, 0.05}}};

SemanticOctree one_voxel() {
  auto tree = SemanticOctree::create({.resolution_m = 0.1}).value();
  EXPECT_TRUE(tree.set_leaf({.key = {32768, 32768, 32768}, .log_odds = 847}));
  return tree;
}

/// A scene that fails leaks what Embree could not release.
Result<std::size_t> update_that_fails(OcclusionScene& scene, const SemanticOctree& tree) {
  fails_next() = true;
  return scene.update(tree);
}

OcclusionScene scene_to_leak() {
#if HYPERMAP_ADDRESS_SANITIZER
  const __lsan::ScopedDisabler leaked;
#endif
  return OcclusionScene::create().value();
}

TEST(OcclusionScene, AfterAFailureItIsFilledAnewThoughTheTreeIsUnchanged) {
  const SemanticOctree tree = one_voxel();
  OcclusionScene scene = scene_to_leak();
  const auto failed = update_that_fails(scene, tree);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::kOutOfMemory);
  EXPECT_EQ(scene.num_bricks(), 0U);
  EXPECT_FALSE(scene.occluded(kAcross)) << "an empty scene";
  EXPECT_EQ(scene.occluded(std::span(&kAcross, 1)), std::vector<std::uint8_t>{0});

  const auto again = scene.update(tree);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(*again, 1U);
  EXPECT_TRUE(scene.occluded(kAcross));
}

TEST(OcclusionScene, WhatChangedBeforeAFailureIsNotForgotten) {
  SemanticOctree tree = one_voxel();
  OcclusionScene scene = scene_to_leak();
  ASSERT_TRUE(scene.update(tree));
  ASSERT_TRUE(tree.set_leaf({.key = {32768, 32778, 32768}, .log_odds = 847}));
  ASSERT_FALSE(update_that_fails(scene, tree));
  EXPECT_EQ(scene.update(tree).value(), 2U) << "both bricks, not the changed one alone";
  EXPECT_TRUE(scene.occluded(kAcross));
}

TEST(OcclusionScene, AnEmbreeThatDoesNotStartIsAnError) {
#if HYPERMAP_ADDRESS_SANITIZER
  const __lsan::ScopedDisabler leaked;
#endif
  fails_next() = true;
  EXPECT_EQ(OcclusionScene::create().error().code, ErrorCode::kOutOfMemory);
}

}  // namespace
}  // namespace hypermap

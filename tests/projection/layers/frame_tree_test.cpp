// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/layers/frame_tree.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hypermap {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

FrameTree tree() {
  FrameTree frames;
  EXPECT_TRUE(frames.add({"map", "lab", 1, 2, kQuarterTurn}));
  EXPECT_TRUE(frames.add({"lab", "desk", 3, 0, 0}));
  EXPECT_TRUE(frames.add({"map", "hall", -5, 0, 0}));
  return frames;
}

Eigen::Vector2d taken(
    const FrameTree& frames, const char* to, const char* from, double x, double y) {
  return *frames.to_from(to, from) * Eigen::Vector2d(x, y);
}

TEST(FrameTree, PosesChainUpAndDown) {
  // The desk's origin is (3, 0) in the lab; turned by 90 degrees (0, 3), moved: (1, 5) in the map,
  // which lies at (6, 5) in the hall.
  const FrameTree frames = tree();
  EXPECT_TRUE(taken(frames, "map", "desk", 0, 0).isApprox(Eigen::Vector2d(1, 5), 1e-12));
  EXPECT_TRUE(taken(frames, "hall", "desk", 0, 0).isApprox(Eigen::Vector2d(6, 5), 1e-12));
  EXPECT_TRUE(taken(frames, "desk", "hall", 6, 5).isZero(1e-12));
  EXPECT_TRUE(taken(frames, "map", "lab", 1, 0).isApprox(Eigen::Vector2d(1, 3), 1e-12));
}

TEST(FrameTree, AFrameIsConnectedToItselfOnly) {
  const FrameTree frames = tree();
  EXPECT_TRUE(frames.to_from("nowhere", "nowhere")->isApprox(Eigen::Isometry2d::Identity()));
  const auto lost = frames.to_from("map", "nowhere");
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(lost.error().what, ::testing::HasSubstr("nothing connects nowhere and map"));
}

TEST(FrameTree, LoopsAndSecondParentsAreRefused) {
  FrameTree frames = tree();
  EXPECT_FALSE(frames.add({"desk", "map", 0, 0, 0}));
  EXPECT_FALSE(frames.add({"hall", "desk", 0, 0, 0}));
  EXPECT_FALSE(frames.add({"a", "a", 0, 0, 0}));
  EXPECT_EQ(frames, tree());
}

TEST(FrameTree, NumbersAndNamesMustBeSane) {
  FrameTree frames;
  EXPECT_FALSE(frames.add({"", "a", 0, 0, 0}));
  EXPECT_FALSE(frames.add({"a", "b", std::nan(""), 0, 0}));
  EXPECT_FALSE(frames.add({"a", "b", 0, 1e18, 0}));
  EXPECT_FALSE(frames.add({"a", "b", 0, 0, HUGE_VAL}));
  EXPECT_TRUE(frames.transforms().empty());
}

}  // namespace
}  // namespace hypermap

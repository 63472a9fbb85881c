// SPDX-License-Identifier: BSD-3-Clause
#include "octree/clamp_trace.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(ClampTrace, TellsByTheStepsWhereEvidenceWasStopped) {
  const ClampTrace trace(SensorModel{});
  EXPECT_TRUE(trace.was_clamped(-2000));
  EXPECT_TRUE(trace.was_clamped(3511));
  EXPECT_TRUE(trace.was_clamped(-2000 + 847));
  EXPECT_TRUE(trace.was_clamped(3511 - 3 * 405));
  EXPECT_FALSE(trace.was_clamped(0));
  EXPECT_FALSE(trace.was_clamped(847));
  EXPECT_FALSE(trace.was_clamped(-4 * 405));
  EXPECT_FALSE(trace.was_clamped(3 * 847 - 5 * 405));
}

TEST(ClampTrace, OfUpdatesThatDivideTheClampsTheClampsAloneTell) {
  const ClampTrace trace(
      SensorModel{.hit = 1000, .miss = -500, .clamp_min = -2000, .clamp_max = 3000});
  EXPECT_TRUE(trace.was_clamped(-2000));
  EXPECT_TRUE(trace.was_clamped(3000));
  EXPECT_FALSE(trace.was_clamped(-500));
  EXPECT_FALSE(trace.was_clamped(1000));
  EXPECT_FALSE(trace.was_clamped(7)) << "no number of updates leads there";
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/segment.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

// [smap] pseudocode 3.3 with table D.1: den = 1.7 - 0.2 = 1.5, obj_ths = 0.2;
// extent 0.5: (1.5 - (0.5 - 0.2)) / 1.5 = 1.2 / 1.5 = 0.8.
TEST(BoxConfidence, FallsWithTheExtentBeyondTheSlack) {
  EXPECT_NEAR(box_confidence(0.5, 0.2, 0.2, 1.7).value(), 0.8, 1e-12);
}

TEST(BoxConfidence, IsOneUpToTheSlackItself) {
  EXPECT_EQ(box_confidence(0.0, 0.2, 0.2, 1.7).value(), 1.0);
  EXPECT_EQ(box_confidence(0.2, 0.2, 0.2, 1.7).value(), 1.0);
  EXPECT_LT(box_confidence(0.201, 0.2, 0.2, 1.7).value(), 1.0);
}

TEST(BoxConfidence, IsNeverBelowZero) {
  EXPECT_EQ(box_confidence(1.7, 0.2, 0.2, 1.7).value(), 0.0);
  EXPECT_EQ(box_confidence(100.0, 0.2, 0.2, 1.7).value(), 0.0);
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/annotation/scale_bar.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(ScaleBar, IsTheLargestRoundLengthThatFits) {
  EXPECT_DOUBLE_EQ(round_length_m(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_length_m(1.99), 1.0);
  EXPECT_DOUBLE_EQ(round_length_m(2.0), 2.0);
  EXPECT_DOUBLE_EQ(round_length_m(4.9), 2.0);
  EXPECT_DOUBLE_EQ(round_length_m(7.3), 5.0);
  EXPECT_DOUBLE_EQ(round_length_m(0.37), 0.2);
  EXPECT_DOUBLE_EQ(round_length_m(1234.0), 1000.0);
}

TEST(ScaleBar, AQuotientThatMissesARoundLengthByRoundingStillCounts) {
  EXPECT_EQ(round_length_m(0.3 - 0.1), 0.2);  // 0.19999999999999998
  EXPECT_EQ(round_length_m(0.1 * 3 - 0.2), 0.1);
}

TEST(ScaleBar, WritesLengthsInTheUnitThatSuitsThem) {
  EXPECT_EQ(length_text(5.0), "5 m");
  EXPECT_EQ(length_text(2.2), "2.2 m");
  EXPECT_EQ(length_text(0.5), "50 cm");
  EXPECT_EQ(length_text(static_cast<double>(0.05F)), "5 cm");
  EXPECT_EQ(length_text(0.002), "2 mm");
  EXPECT_EQ(length_text(2000.0), "2 km");
}

}  // namespace
}  // namespace hypermap

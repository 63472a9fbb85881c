// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/depth_cloud.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(IsMeasured, RefusesZeroNegativeNanAndInfinity) {
  EXPECT_TRUE(is_measured(0.5F));
  for (const float depth : {0.0F,
                            -1.0F,
                            std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()}) {
    EXPECT_FALSE(is_measured(depth));
  }
}

// 0.0012 + 0.0019 * (2.4 - 0.4)^2 = 0.0012 + 0.0076.
TEST(AxialNoise, GrowsWithTheSquareOfDepth) {
  EXPECT_NEAR(axial_noise_m(2.4), 0.0088, 1e-12);
  EXPECT_NEAR(axial_noise_m(0.4), 0.0012, 1e-12);
}

// Centres lie at n + 0.5: 1.5, 2.5 and 3.5 are in [1.5, 4.5), 4.5 is not.
TEST(PixelsIn, TakesPixelsWhoseCentreIsInTheHalfOpenBox) {
  EXPECT_EQ(pixels_in({1.5, 0.0, 4.5, 2.0}, 10, 10), (PixelRect{1, 0, 4, 2}));
  EXPECT_EQ(pixels_in({1.0, 2.0, 2.0, 3.0}, 10, 10), (PixelRect{1, 2, 2, 3}));
}

TEST(PixelsIn, CutsAtTheImageAndGrowsByTheMargin) {
  EXPECT_EQ(pixels_in({-5.0, 3.0, 1e300, 5.0}, 10, 8), (PixelRect{0, 3, 10, 5}));
  EXPECT_EQ(pixels_in({3.0, 3.0, 5.0, 5.0}, 10, 8, 1.0, 2.0), (PixelRect{2, 1, 6, 7}));
}

TEST(PixelsIn, IsEmptyForBoxesThatHoldNothing) {
  for (const PixelBox& box : {PixelBox{5, 5, 5, 6},
                              PixelBox{6, 5, 5, 6},
                              PixelBox{kNaN, 0, 5, 5},
                              PixelBox{0, 0, 5, kNaN},
                              PixelBox{20, 0, 30, 5},
                              PixelBox{-kInf, 0, -5, 5},
                              PixelBox{2.6, 2.0, 3.4, 4.0}}) {
    EXPECT_TRUE(pixels_in(box, 10, 10).empty());
  }
}

}  // namespace
}  // namespace hypermap

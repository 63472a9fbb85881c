// SPDX-License-Identifier: BSD-3-Clause
#include "footprints/mask_outline.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hypermap {
namespace {

PlanMask block(int cols, int rows, int from, int to) {
  PlanMask mask(cols, rows);
  for (int row = from; row < to; ++row) {
    for (int col = from; col < to; ++col) mask.set(col, row);
  }
  return mask;
}

TEST(MaskOutline, OfASquareIsTheSquareWithoutItsCorners) {
  const MaskFrame frame{.corner = {10.0, -4.0}, .edge_m = 0.5};
  const auto outline = outline_of(block(8, 8, 2, 6), frame);
  ASSERT_TRUE(outline);
  // Four pixels of 0.5 m a side; each corner lacks a triangle with legs of half a pixel.
  EXPECT_NEAR(area_m2(*outline), 4.0 - 4 * 0.5 * 0.25 * 0.25, 1e-12);
  EXPECT_TRUE(centroid(*outline).isApprox(Eigen::Vector2d(12.0, -2.0)));
  EXPECT_LE(outline->outer.size(), 8U);
}

TEST(MaskOutline, OfOnePixelIsTheDiamondOfItsEdgesMiddles) {
  const auto outline = outline_of(block(3, 3, 1, 2), {.corner = {0, 0}, .edge_m = 2.0});
  ASSERT_TRUE(outline);
  EXPECT_NEAR(area_m2(*outline), 2.0, 1e-12);
}

TEST(MaskOutline, FollowsPixelsAtTheEdgeOfTheRaster) {
  const auto outline = outline_of(block(4, 4, 0, 4), {.corner = {0, 0}, .edge_m = 1.0});
  ASSERT_TRUE(outline);
  EXPECT_NEAR(area_m2(*outline), 15.5, 1e-12);
}

TEST(MaskOutline, OfNothingIsNotFound) {
  EXPECT_EQ(outline_of(PlanMask(4, 4), {}).error().code, ErrorCode::kNotFound);
}

TEST(MaskOutline, HasTheAreaOfItsPixelsWhateverTheirShape) {
  std::mt19937 random(11);
  std::bernoulli_distribution is_set(0.5);
  for (int run = 0; run < 50; ++run) {
    PlanMask noise(40, 30);
    for (int row = 4; row < 26; ++row) {
      for (int col = 4; col < 36; ++col) noise.set(col, row, is_set(random));
    }
    const PlanMask filled = with_holes_filled(without_corner_contacts(closed(noise, 1)));
    const MaskParts part = without_specks(without_corner_contacts(filled), 1.0);
    if (part.num_parts != 1) continue;
    const auto outline = outline_of(part.mask, {.corner = {0, 0}, .edge_m = 1.0});
    ASSERT_TRUE(outline);
    const auto num_pixels = static_cast<double>(part.mask.count());
    // Corners cut off, and those left out within half a pixel of the outline.
    EXPECT_NEAR(area_m2(*outline), num_pixels, 0.1 * num_pixels);
  }
}

}  // namespace
}  // namespace hypermap

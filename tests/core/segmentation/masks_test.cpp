// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/core/segmentation/masks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

namespace hypermap {
namespace {

MaskImage random_mask(std::mt19937& random, std::uint32_t one_of) {
  MaskImage mask(1 + static_cast<int>(random() % 17), 1 + static_cast<int>(random() % 17));
  for (std::uint8_t& pixel : mask.pixels()) pixel = random() % one_of == 0 ? 1 : 0;
  return mask;
}

TEST(Masks, AreOffByOneAndAHalfOfTheirCells) {
  EXPECT_DOUBLE_EQ(mask_tolerance_px(640, 480), 6.0);
  EXPECT_DOUBLE_EQ(mask_tolerance_px(320, 240), 3.0);
  EXPECT_DOUBLE_EQ(mask_tolerance_px(1080, 1920), 18.0);
}

TEST(Masks, MayReachOneAndAHalfCellsFartherRoundedUp) {
  MaskImage mask(160, 320);  // cells of two pixels
  mask.at(80, 160) = 1;
  EXPECT_EQ(bounds_of(widened_by_tolerance(mask)), (PixelRect{77, 157, 84, 164}));
}

TEST(Masks, AreWidenedAsByLookingAtEachNeighbour) {
  std::mt19937 random(7);
  for (int round = 0; round < 40; ++round) {
    const MaskImage mask = random_mask(random, 9);
    const int reach = static_cast<int>(random() % 5);
    const MaskImage found = widened(mask, reach);
    for (int v = 0; v < mask.height_px(); ++v) {
      for (int u = 0; u < mask.width_px(); ++u) {
        bool is_near = false;
        for (int y = v - reach; y <= v + reach; ++y) {
          for (int x = u - reach; x <= u + reach; ++x)
            is_near = is_near || (mask.contains(x, y) && mask.at(x, y) != 0);
        }
        EXPECT_EQ(found.at(u, v), is_near ? 1 : 0) << u << ", " << v << ", " << reach;
      }
    }
  }
}

TEST(Masks, HaveTheBoundsOfTheirPixels) {
  std::mt19937 random(11);
  for (int round = 0; round < 40; ++round) {
    const MaskImage mask = random_mask(random, 40);
    PixelRect bounds;
    for (int v = 0; v < mask.height_px(); ++v) {
      for (int u = 0; u < mask.width_px(); ++u) {
        if (mask.at(u, v) != 0) bounds = united(bounds, {u, v, u + 1, v + 1});
      }
    }
    EXPECT_EQ(bounds_of(mask), bounds);
  }
  EXPECT_TRUE(bounds_of(MaskImage()).empty());
}

TEST(Masks, ReachOutOfTheirBoxes) {
  Detection detection;
  detection.box_px = {2, 3, 4, 5};
  EXPECT_EQ(box_with_mask(detection), detection.box_px);
  detection.mask = MaskImage(10, 10);
  EXPECT_EQ(box_with_mask(detection), detection.box_px) << "nothing is in the mask";
  detection.mask->at(3, 7) = 1;
  EXPECT_EQ(box_with_mask(detection), (PixelBox{2, 3, 4, 8}));
  detection.mask->at(9, 0) = 1;
  EXPECT_EQ(box_with_mask(detection), (PixelBox{2, 0, 10, 8}));
}

}  // namespace
}  // namespace hypermap

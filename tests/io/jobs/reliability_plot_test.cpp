// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/reliability_plot.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(ReliabilityPlot, ABinStandsAtItsProbabilityAndShare) {
  // Panels of 400 px after margins of 40 px: 0.25 is 100 px from the left, 0.75 is 100 px from the
  // top.
  CalibrationReport best_class;
  best_class.bins = {{3, 0.25, 0.75}};
  const ColorImage image = draw_reliability(best_class, {});
  EXPECT_EQ(image.width_px(), 921);
  EXPECT_EQ(image.height_px(), 481);
  EXPECT_EQ(image.at(140, 140), (Rgb8{31, 119, 180}));
  EXPECT_EQ(image.at(144, 144), (Rgb8{31, 119, 180}));
  EXPECT_NE(image.at(145, 145), (Rgb8{31, 119, 180}));
  EXPECT_EQ(image.at(140, 220), (Rgb8{170, 170, 170}));  // from the square down to the diagonal
  EXPECT_EQ(image.at(580, 140), (Rgb8{255, 255, 255}));  // the other panel has none
}

TEST(ReliabilityPlot, TheCornersOfThePanelsAreInTheImage) {
  CalibrationReport ends;
  ends.bins = {{1, 0.0, 0.0}, {1, 1.0, 1.0}};
  const ColorImage image = draw_reliability(ends, ends);
  EXPECT_EQ(image.at(480, 440), (Rgb8{220, 110, 10}));
  EXPECT_EQ(image.at(880, 40), (Rgb8{220, 110, 10}));
}

/// Whether any pixel of columns [left, right) and rows [top, bottom) is of this colour.
bool bears(const ColorImage& image, int left, int top, int right, int bottom, Rgb8 color) {
  for (int v = top; v < bottom; ++v) {
    for (int u = left; u < right; ++u) {
      if (image.at(u, v) == color) return true;
    }
  }
  return false;
}

TEST(ReliabilityPlot, TheAxesBearTheirWords) {
  const ColorImage image = draw_reliability({}, {});
  const Rgb8 blue{31, 119, 180};
  const Rgb8 orange{220, 110, 10};
  const Rgb8 grey{90, 90, 90};
  for (const int left : {40, 480}) {
    const Rgb8 color = left == 40 ? blue : orange;
    EXPECT_TRUE(bears(image, left, 0, left + 400, 40, color)) << "above: share true";
    EXPECT_TRUE(bears(image, left, 462, left + 400, 481, color)) << "below: P(...)";
    EXPECT_TRUE(bears(image, left - 40, 220, left - 1, 260, grey)) << "left: 0.5";
  }
  // The 1 under the left panel ends with it: its letter begins 12 px before 440 and 6 px below 440;
  // the bottom row of dots is 01110, two pixels each.
  for (int u = 428; u < 438; ++u) {
    EXPECT_EQ(image.at(u, 446 + 13) == grey, u >= 430 && u < 436) << u;
  }
}

}  // namespace
}  // namespace hypermap

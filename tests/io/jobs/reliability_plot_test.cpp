// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/reliability_plot.hpp"

#include <gtest/gtest.h>

namespace hypermap {
namespace {

TEST(ReliabilityPlot, ABinStandsAtItsProbabilityAndShare) {
  // Panels of 400 px after margins of 20 px: 0.25 is 100 px from the left, 0.75 is 100 px from the
  // top.
  CalibrationReport best_class;
  best_class.bins = {{3, 0.25, 0.75}};
  const ColorImage image = draw_reliability(best_class, {});
  EXPECT_EQ(image.width_px(), 861);
  EXPECT_EQ(image.height_px(), 441);
  EXPECT_EQ(image.at(120, 120), (Rgb8{31, 119, 180}));
  EXPECT_EQ(image.at(124, 124), (Rgb8{31, 119, 180}));
  EXPECT_NE(image.at(125, 125), (Rgb8{31, 119, 180}));
  EXPECT_EQ(image.at(120, 200), (Rgb8{170, 170, 170}));  // from the square down to the diagonal
  EXPECT_EQ(image.at(540, 120), (Rgb8{255, 255, 255}));  // the other panel has none
}

TEST(ReliabilityPlot, TheCornersOfThePanelsAreInTheImage) {
  CalibrationReport ends;
  ends.bins = {{1, 0.0, 0.0}, {1, 1.0, 1.0}};
  const ColorImage image = draw_reliability(ends, ends);
  EXPECT_EQ(image.at(440, 420), (Rgb8{220, 110, 10}));
  EXPECT_EQ(image.at(840, 20), (Rgb8{220, 110, 10}));
}

}  // namespace
}  // namespace hypermap

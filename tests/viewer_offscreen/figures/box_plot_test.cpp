// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/figures/box_plot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>

namespace hypermap {
namespace {

constexpr Rgb8 kFill{165, 200, 225};

/// First and last column that have the colour of boxes.
struct Columns {
  int first = 0;
  int last = 0;
};

std::optional<Columns> filled_columns(const ColorImage& plot) {
  std::optional<Columns> columns;
  for (int u = 0; u < plot.width_px(); ++u) {
    for (int v = 0; v < plot.height_px(); ++v) {
      if (plot.at(u, v) != kFill) continue;
      columns = columns ? Columns{columns->first, u} : Columns{u, u};
    }
  }
  return columns;
}

BoxPlotRow row(FiveNumbers numbers) {
  return {"step", numbers};
}

TEST(BoxPlot, ABoxReachesFromQuartileToQuartileOnTheLogarithmicAxis) {
  // The axis is 1 to 100: the quartiles at its first and third quarter, 10^0.5 and 10^1.5.
  const std::array rows{row({1.0, 3.1622776601683795, 10.0, 31.622776601683793, 100.0})};
  const auto columns = filled_columns(draw_box_plot("times", "ms", rows).value());
  ASSERT_TRUE(columns);
  EXPECT_NEAR(columns->first, 150 + 0.25 * 660, 3);
  EXPECT_NEAR(columns->last, 150 + 0.75 * 660, 3);
}

TEST(BoxPlot, EachRowMakesItHigher) {
  const std::array one{row({1, 2, 3, 4, 5})};
  const std::array two{row({1, 2, 3, 4, 5}), row({2, 4, 6, 8, 10})};
  const int height_px = draw_box_plot("", "", one).value().height_px();
  EXPECT_EQ(draw_box_plot("", "", two).value().height_px(), height_px + 38);
}

TEST(BoxPlot, NothingAndZerosAreDrawnAsWell) {
  EXPECT_TRUE(draw_box_plot("none", "ms", {}));
  const std::array zeros{row({})};
  EXPECT_FALSE(filled_columns(draw_box_plot("zeros", "ms", zeros).value()))
      << "at the lower end, without width";
  EXPECT_TRUE(draw_box_plot("one power", "ms", std::array{row({1, 1, 1, 1, 1})}));
}

}  // namespace
}  // namespace hypermap

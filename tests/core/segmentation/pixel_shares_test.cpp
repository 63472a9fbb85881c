// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/policies/pixel_shares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

/// 60 x 20 pixels of one surface 2 m away; our box from column 10 to 30, all rows.
DepthWindow one_surface() {
  DepthWindow window;
  window.rect = {0, 0, 60, 20};
  window.box_px = {.u_min_px = 10, .v_min_px = 0, .u_max_px = 30, .v_max_px = 20};
  window.box = {10, 0, 30, 20};
  window.tolerant_box = {9, 0, 31, 20};
  window.slope_x.assign(60, 0.0F);
  window.slope_y.assign(20, 0.0F);
  window.depth_m.assign(60UL * 20UL, 2.0F);
  window.step_m.assign(window.size(), 0.05F);
  return window;
}

CompetingBox box_between(int u_begin, int u_end, int v_begin = 0, int v_end = 20) {
  return {.box_px = {.u_min_px = static_cast<double>(u_begin),
                     .v_min_px = static_cast<double>(v_begin),
                     .u_max_px = static_cast<double>(u_end),
                     .v_max_px = static_cast<double>(v_end)},
          .cells = {u_begin, v_begin, u_end, v_end}};
}

/// Kinds of the cells of a window whose cells all had kind `before`.
std::vector<std::uint8_t> kinds_of(const DepthWindow& window, std::uint8_t before = 0) {
  const std::vector<std::uint8_t> kind(window.size(), before);
  return shared_out(window, connected_components(window, kind), kind);
}

/// The columns of row `y` that are another detection's: [begin, end).
std::pair<int, int> columns_of_other(const DepthWindow& window,
                                     const std::vector<std::uint8_t>& kinds,
                                     int y) {
  int begin = 0;
  while (begin < 60 && kinds[window.cell(begin, y)] != kOthersKind) ++begin;
  int end = begin;
  while (end < 60 && kinds[window.cell(end, y)] == kOthersKind) ++end;
  return {begin, end};
}

std::ptrdiff_t num_of_other(const std::vector<std::uint8_t>& kinds) {
  return std::count(kinds.begin(), kinds.end(), kOthersKind);
}

TEST(PixelShares, WithoutAnotherBoxAllStays) {
  const DepthWindow window = one_surface();
  EXPECT_EQ(kinds_of(window), std::vector<std::uint8_t>(window.size(), 0));
}

TEST(PixelShares, ASurfaceBeyondOurBoxIsTheOthers) {
  // Ours ends at 30, theirs is 30 to 50: what is left is ours, as before.
  DepthWindow window = one_surface();
  window.competing_boxes = {box_between(30, 50)};
  const auto kinds = kinds_of(window);
  EXPECT_EQ(columns_of_other(window, kinds, 7), std::pair(30, 50));
  EXPECT_EQ(num_of_other(kinds), 20 * 20);
}

TEST(PixelShares, WhereBoxesOverlapTheNearerMiddleDecides) {
  // Ours is 10 to 30, theirs 24 to 44, as wide: the border is in the middle of 24 to 30.
  DepthWindow window = one_surface();
  window.competing_boxes = {box_between(24, 44)};
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 10), std::pair(27, 44));
}

/// Columns [begin, end) of the window are `depth_m` away; steps are no edges, so that all is one
/// surface.
void place_at(DepthWindow& window, int begin, int end, float depth_m) {
  for (int y = 0; y < 20; ++y) {
    for (int x = begin; x < end; ++x) window.depth_m[window.cell(x, y)] = depth_m;
  }
  window.step_m.assign(window.size(), 0.5F);
}

TEST(PixelShares, WhereOneStandsBeforeTheOtherDepthDecides) {
  // Ours is 10 to 30, theirs 24 to 44. Ours alone is 2 m away and theirs 2.1 m: up to column 29
  // all is nearer than 2.05 m, so that the border is there and not at 27.
  DepthWindow window = one_surface();
  window.competing_boxes = {box_between(24, 44)};
  place_at(window, 29, 60, 2.1F);
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 10), std::pair(29, 44));
  // The same from the side of the one behind.
  window.box_px = box_between(24, 44).box_px;
  window.box = box_between(24, 44).cells;
  window.competing_boxes = {box_between(10, 30)};
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 10), std::pair(10, 29));
}

TEST(PixelShares, AStepThatIsSmallOrWithinTheSpreadTellsNoOrder) {
  DepthWindow window = one_surface();
  window.competing_boxes = {box_between(24, 44)};
  place_at(window, 29, 60, 2.019F);
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 10), std::pair(27, 44)) << "19 mm";
  // Ours alone is 2 m and 2.4 m away by halves, 2.2 +- 0.2 m; theirs alone 2.29 m: 0.09 m
  // apart, less than half of the spread.
  place_at(window, 10, 17, 2.0F);
  place_at(window, 17, 24, 2.4F);
  place_at(window, 24, 60, 2.29F);
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 10), std::pair(27, 44)) << "spread";
}

TEST(PixelShares, TooLittleAloneTellsNoOrder) {
  // Theirs alone is one of 20 columns, a share of 0.05; of half its rows 0.025.
  DepthWindow window = one_surface();
  window.competing_boxes = {box_between(11, 31)};
  place_at(window, 26, 60, 2.1F);
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 10), std::pair(26, 31));
  for (int y = 0; y < 10; ++y) window.depth_m[window.cell(30, y)] = 0.0F;
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 10), std::pair(21, 31));
}

TEST(PixelShares, AnInnerBoxHasItsPixelsAndAnOuterOneThoseOutside) {
  DepthWindow window = one_surface();
  window.competing_boxes = {box_between(14, 20, 5, 15)};
  EXPECT_EQ(num_of_other(kinds_of(window)), 6 * 10);
  // 12 to 30 of 20 rows lies in 0 to 60: all of our box stays ours.
  window.competing_boxes = {box_between(0, 60)};
  EXPECT_EQ(num_of_other(kinds_of(window)), 40 * 20);
  EXPECT_EQ(columns_of_other(window, kinds_of(window), 3), std::pair(0, 10));
}

TEST(PixelShares, ASurfaceThatDoesNotFillTheOtherBoxStaysWhole) {
  // Ours ends at column 33: 3 of 20 columns of the other box, less than a fifth. Behind it is a
  // wall.
  DepthWindow window = one_surface();
  for (int y = 0; y < 20; ++y) {
    for (int x = 33; x < 60; ++x) window.depth_m[window.cell(x, y)] = 3.0F;
  }
  window.competing_boxes = {box_between(30, 50)};
  const auto kinds = kinds_of(window);
  EXPECT_EQ(columns_of_other(window, kinds, 0), std::pair(60, 60))
      << "the wall is not in our box, so that nothing is shared";
}

TEST(PixelShares, PlanesOfTheBackgroundAndMasksAreNotShared) {
  DepthWindow window = one_surface();
  window.competing_boxes = {box_between(30, 50)};
  EXPECT_EQ(num_of_other(kinds_of(window, 1)), 0);
  window.in_mask = MaskImage(window.width(), window.height(), 1);
  EXPECT_EQ(num_of_other(kinds_of(window)), 0);
}

}  // namespace
}  // namespace hypermap

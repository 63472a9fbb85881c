// SPDX-License-Identifier: BSD-3-Clause
// Which pixels of a detection's box show something that it does not mean.
#include "core/segmentation/office_scene.hpp"
#include "hypermap/core/segmentation/geometric_segmentation.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <utility>

namespace hypermap {
namespace {

using test::BoxScene;
using test::detection_of;
using test::kChair;
using test::kFloor;
using test::kTable;
using test::kWall;
using test::SceneView;

/// Two columns and a row of cells of 4 pixels, the right one of background, cut after 3.
BackgroundCells cells_at_20_10() {
  BackgroundCells cells{.rect = {20, 10, 27, 14}, .block_px = 4, .is_background = MaskImage(2, 1)};
  cells.is_background.at(1, 0) = 1;
  return cells;
}

TEST(BackgroundCells, HoldThePixelsOfTheirCells) {
  const BackgroundCells cells = cells_at_20_10();
  EXPECT_FALSE(cells.contains(23, 10));
  EXPECT_TRUE(cells.contains(24, 10));
  EXPECT_TRUE(cells.contains(26, 13));
  EXPECT_FALSE(cells.contains(27, 13)) << "to the right of all";
  EXPECT_FALSE(cells.contains(26, 14)) << "below all";
  EXPECT_FALSE(cells.contains(26, 9));
  EXPECT_FALSE(cells.contains(19, 10));
}

TEST(BackgroundCells, SurroundOnlyWhatIsAmidThem) {
  const BackgroundCells cells = cells_at_20_10();
  EXPECT_TRUE(cells.surrounds(25, 11));
  EXPECT_FALSE(cells.surrounds(24, 11)) << "the pixel to the left is none";
  EXPECT_FALSE(cells.surrounds(26, 11));
  EXPECT_FALSE(cells.surrounds(25, 10));
  EXPECT_FALSE(cells.surrounds(25, 13));
}

TEST(BackgroundCells, OfNothingHoldNothing) {
  EXPECT_FALSE(BackgroundCells{}.contains(0, 0));
  EXPECT_FALSE(
      (BackgroundCells{.rect = {0, 0, 8, 8}, .block_px = 1, .is_background = {}}).contains(4, 4));
}

/// How many pixels of the box show a solid, and how many of those are of the background.
struct Shown {
  std::size_t pixels = 0;
  std::size_t background = 0;

  [[nodiscard]] double share() const {
    return static_cast<double>(background) / static_cast<double>(pixels);
  }
};

Shown shown(const SceneView& view, const Detection& detection, const Segment& segment, int label) {
  Shown count;
  const PixelRect box = pixels_in(detection.box_px, 640, 480);
  for (int v = box.v_begin; v < box.v_end; ++v) {
    for (int u = box.u_begin; u < box.u_end; ++u) {
      if (view.truth.at(u, v) != label) continue;
      ++count.pixels;
      count.background += segment.background.contains(u, v) ? 1U : 0U;
    }
  }
  return count;
}

/// A chair before a wall and behind a bar, both wider than its box.
SceneView chair_between() {
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0}).add(kWall, {4, -4, 0}, {4.1, 4, 3});
  scene.add(kChair, {2.6, -0.4, 0}, {2.8, 0.4, 1.2}).add(kTable, {1.8, -2, 0.5}, {1.9, 2, 0.6});
  return scene.view(test::look_at({0, 0, 0.9}, {2.6, 0, 0.6}), 3);
}

TEST(BackgroundSurfaces, AreThoseThatRunOnBeyondTheBox) {
  const SceneView view = chair_between();
  Detection chair = detection_of(view, kChair);
  chair.box_px.u_min_px -= 10;  // the wall, too
  const auto found = segment(view.frame, chair, {});
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_LE(shown(view, chair, *found, kChair).share(), 0.05) << "but for its lowest centimetres";
  EXPECT_GE(shown(view, chair, *found, kTable).share(), 0.9);
  EXPECT_GE(shown(view, chair, *found, kWall).share(), 0.9);
}

TEST(BackgroundSurfaces, AreNotPlanesThatOnlyGoOnElsewhere) {
  // The seats of three chairs are of one height; the one in the middle ends within its box.
  BoxScene scene;
  scene.add(kFloor, {-1, -4, -0.1}, {6, 4, 0});
  for (const double y_m : {-0.7, 0.0, 0.7})
    scene.add(
        kChair + static_cast<int>(10 * (y_m + 0.7)), {2, y_m - 0.2, 0.4}, {2.4, y_m + 0.2, 0.45});
  const SceneView view = scene.view(test::look_at({0, 0, 1.4}, {2.2, 0, 0.4}), 3);
  const Detection seat = detection_of(view, kChair + 7);
  const auto found = segment(view.frame, seat, {});
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_EQ(shown(view, seat, *found, kChair + 7).background, 0U);
}

TEST(BackgroundSurfaces, AreAllThatAMaskLeavesOut) {
  const SceneView view = chair_between();
  Detection chair = detection_of(view, kChair);
  chair.mask = MaskImage(640, 480);
  for (std::size_t i = 0; i < view.truth.size(); ++i)
    chair.mask->pixels()[i] = view.truth.pixels()[i] == kChair ? 1 : 0;
  const auto found = segment(view.frame, chair, {});
  ASSERT_TRUE(found.has_value()) << to_string(found.error());
  EXPECT_EQ(shown(view, chair, *found, kChair).background, 0U);
  const Shown bar = shown(view, chair, *found, kTable);
  EXPECT_GT(bar.background, 0U);
  EXPECT_LT(bar.share(), 1.0) << "not where the mask's edge may be off";
}

}  // namespace
}  // namespace hypermap

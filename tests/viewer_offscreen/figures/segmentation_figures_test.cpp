// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/viewer_offscreen/figures/segmentation_figures.hpp"

#include "hypermap/core/base/class_palette.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hypermap {
namespace {

constexpr Rgb8 kGrey{100, 100, 100};

/// A wall 2 m away, its left half 1 m away, the upper quarter not measured; one detection.
RgbdFrame small_frame() {
  RgbdFrame frame;
  frame.name = "wall";
  frame.camera = {48, 32, 40.0, 40.0, 23.5, 15.5};
  frame.depth_m = DepthImage(48, 32, 2.0F);
  frame.color = ColorImage(48, 32, kGrey);
  for (int v = 0; v < 32; ++v) {
    for (int u = 0; u < 24; ++u) frame.depth_m.at(u, v) = 1.0F;
  }
  for (int v = 0; v < 8; ++v) {
    for (int u = 0; u < 48; ++u) frame.depth_m.at(u, v) = 0.0F;
  }
  Detection detection;
  detection.box_px = {10.0, 12.0, 30.0, 26.0};
  detection.class_scores = {{ClassId{0}, Probability(1.0)}};
  detection.score = Probability(0.9);
  frame.detections = {detection};
  return frame;
}

ClassRegistry one_class() {
  ClassRegistry classes;
  EXPECT_TRUE(classes.add("chair"));
  return classes;
}

std::size_t count_of(const ColorImage& image, Rgb8 color) {
  return static_cast<std::size_t>(std::ranges::count(image.pixels(), color));
}

/// A trace of two steps: the box, then its left half.
SegmentationTrace two_steps() {
  SegmentationTrace trace{.steps = {},
                          .segment = fail(ErrorCode::kNotFound, "no point was left", "here")};
  for (const int end : {30, 20}) {
    SegmentationStep step{.name = "half", .labels = LabelImage(48, 32, kLabelAbsent)};
    for (int v = 12; v < 26; ++v) {
      for (int u = 10; u < end; ++u) step.labels.at(u, v) = 1;
    }
    trace.steps.push_back(std::move(step));
  }
  return trace;
}

class FiguresTest : public testing::Test {
 protected:
  const RgbdFrame frame = small_frame();
  const SegmentationFigures figures = SegmentationFigures::create().value();
};

TEST_F(FiguresTest, DetectionsStandOverTheWholeFrame) {
  const ColorImage figure = figures.detections(frame, one_class());
  EXPECT_EQ(figure.width_px(), 48 * 20) << "960 pixels are twenty times 48";
  EXPECT_GT(figure.height_px(), 32 * 20) << "and a line of text below";
  EXPECT_EQ(figure.at(2, 2), kGrey);
  EXPECT_NE(figure.at(20 * 20, 26 * 20), kGrey) << "the lower edge of the box";
}

TEST_F(FiguresTest, TheEdgeOfAMaskIsInTheColourOfItsClass) {
  RgbdFrame masked = frame;
  masked.detections[0].mask = MaskImage(48, 32);
  for (int v = 18; v < 22; ++v) {
    for (int u = 14; u < 19; ++u) masked.detections[0].mask->at(u, v) = 1;
  }
  const ColorImage figure = figures.detections(masked, one_class());
  const auto at = [&](int u, int v) { return figure.at(20 * u + 10, 20 * v + 10); };
  EXPECT_EQ(at(14, 18), class_color("chair"));
  EXPECT_EQ(at(18, 20), class_color("chair"));
  EXPECT_EQ(at(16, 20), kGrey) << "inside";
  EXPECT_EQ(at(13, 20), kGrey) << "outside";
}

TEST_F(FiguresTest, AStepShowsWhatItKeepsAndWhatItDropped) {
  const ColorImage first = figures.step(frame, frame.detections[0], two_steps(), 0);
  const ColorImage second = figures.step(frame, frame.detections[0], two_steps(), 1);
  ASSERT_EQ(first.width_px(), second.width_px());
  // The figure shows the whole frame, 48 x 32: the margin of 24 pixels leaves the image.
  const int scale = first.width_px() / 48;
  const auto at = [&](const ColorImage& image, int u, int v) {
    return image.at(scale * u + scale / 2, scale * v + scale / 2);
  };
  EXPECT_EQ(at(first, 15, 20), at(second, 15, 20)) << "kept by both";
  EXPECT_EQ(at(first, 25, 20), at(first, 15, 20));
  const Rgb8 dropped = at(second, 25, 20);
  EXPECT_GT(dropped.r, dropped.g + 30) << "red";
  const Rgb8 dimmed = at(second, 40, 5);
  EXPECT_EQ(dimmed, (Rgb8{45, 45, 45})) << "0.45 of 100";
}

TEST_F(FiguresTest, ASegmentHasTheEdgesOfItsBox) {
  Segment segment;
  segment.points_in_map = {{-0.2F, -0.1F, 1.0F}, {0.1F, 0.2F, 1.2F}};
  segment.box = bounding_box(segment.points_in_map);
  segment.pixel_indices = {20 * 48 + 15};
  const Rgb8 edge{255, 140, 0};
  EXPECT_GT(count_of(figures.segment(frame, frame.detections[0], segment), edge), 100U);
  EXPECT_EQ(count_of(figures.segment(frame, frame.detections[0], two_steps().segment), edge), 0U);
}

TEST_F(FiguresTest, PanelsAreColouredByTheirNearestPoint) {
  const auto panels = BinnedDepthMap::create(frame, {.columns = 4, .rows = 4});
  const ColorImage figure = figures.panels(frame, panels);
  const int side_px = figure.width_px() / 4;
  const auto near_corner = [&](int column, int row) {
    return figure.at(column * side_px + 12, row * figure.width_px() / 6 + 12);
  };
  const Rgb8 empty = near_corner(0, 0);
  const Rgb8 near = near_corner(0, 2);
  const Rgb8 far = near_corner(3, 2);
  EXPECT_EQ(empty, (Rgb8{45, 45, 45}));
  EXPECT_GT(near.g, near.b + 50) << "yellow";
  EXPECT_GT(far.b, far.g + 20) << "violet";
}

TEST_F(FiguresTest, FromAboveIsToScaleAndAnEmptyImageIsDrawnAsWell) {
  const auto panels = BinnedDepthMap::create(frame, {.columns = 4, .rows = 4});
  EXPECT_GT(figures.panels_from_above(panels).width_px(), 100);
  RgbdFrame blind = frame;
  blind.color = {};
  std::ranges::fill(blind.depth_m.pixels(), 0.0F);
  const auto nothing = BinnedDepthMap::create(blind, {});
  EXPECT_GT(figures.panels_from_above(nothing).width_px(), 0);
  EXPECT_EQ(figures.panels(blind, nothing).at(10, 10), Rgb8{}) << "black, neither colour nor depth";
}

}  // namespace
}  // namespace hypermap

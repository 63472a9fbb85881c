// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/policies/surface_score.hpp"

#include "hypermap/core/segmentation/rgbd_frame.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr int kSide = 100;
constexpr PixelRect kBox{20, 20, 80, 80};
constexpr double kWhole = 1000.0;  ///< Score of what has 1,000 cells in the box and spans it.

PixelRect mirrored(const PixelRect& rect) {
  return {rect.v_begin, rect.u_begin, rect.v_end, rect.u_end};
}

/// The score of a surface of 1,000 cells, all in the box, which it spans, that has these bounds.
double score_of(const PixelRect& bounds, const PixelRect& box, std::vector<CompetingBox> others) {
  DepthWindow window;
  window.rect = {0, 0, kSide, kSide};
  window.box = box;
  window.tolerant_box = box;
  window.slope_x.assign(kSide, 0.0F);
  window.slope_y.assign(kSide, 0.0F);
  window.depth_m.assign(std::size_t{kSide} * kSide, 2.0F);
  window.step_m.assign(window.size(), 0.06F);
  window.competing_boxes = std::move(others);
  const DepthImage depth_m(kSide, kSide, 2.0F);
  const DepthComponents surfaces{
      .of_cell = std::vector<std::uint32_t>(window.size(), kNoComponent),
      .components = {{.num_in_box = 1000, .bounds_in_box = box, .bounds = bounds}}};
  const SupportContacts contacts(depth_m, window, surfaces, {}, Eigen::Vector3f{0, -1, 0});
  return surface_score(window, surfaces, contacts, 0);
}

/// The same along columns and along rows.
void expect_score(const PixelRect& bounds, double expected, const PixelRect& box = kBox) {
  EXPECT_DOUBLE_EQ(score_of(bounds, box, {}), expected);
  EXPECT_DOUBLE_EQ(score_of(mirrored(bounds), mirrored(box), {}), expected) << "along rows";
}

TEST(SurfaceScore, IsAQuarterForWhatReachesBeyondAnEnd) {
  expect_score(kBox, kWhole);
  expect_score({30, 20, 89, 80}, kWhole);  // 9 of 60 cells
  expect_score({30, 20, 90, 80}, kWhole / 4);
  expect_score({10, 20, 70, 80}, kWhole / 4);
  expect_score({10, 20, 90, 80}, kWhole / 4);
}

TEST(SurfaceScore, IsWholeWhereTheBoxIsTooNarrowAtOneEnd) {
  expect_score({20, 20, 95, 80}, kWhole);
  expect_score({23, 20, 95, 80}, kWhole);  // 3 of 60 cells
  expect_score({24, 20, 95, 80}, kWhole / 4);
  expect_score({5, 20, 78, 80}, kWhole);
}

TEST(SurfaceScore, NothingEndsWithABoxThatThePictureCuts) {
  expect_score({0, 20, 75, 80}, kWhole / 4, {0, 20, 60, 80});
  expect_score({25, 20, 100, 80}, kWhole / 4, {40, 20, 100, 80});
}

TEST(SurfaceScore, ACellBeyondASmallBoxIsNothing) {
  expect_score({51, 50, 57, 56}, kWhole, {50, 50, 56, 56});  // a sixth
  expect_score({52, 50, 58, 56}, kWhole / 4, {50, 50, 56, 56});
}

TEST(SurfaceScore, IsLeastForWhatAnotherBoxIsAbout) {
  const PixelRect surface{30, 20, 90, 80};
  EXPECT_DOUBLE_EQ(score_of(surface, kBox, {{.box_px = {}, .cells = surface}}), kWhole / 40);
  EXPECT_DOUBLE_EQ(score_of(surface, kBox, {{.box_px = {}, .cells = {0, 0, 10, 10}}}), kWhole / 4);
}

}  // namespace
}  // namespace hypermap

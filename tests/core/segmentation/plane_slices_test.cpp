// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/plane_slices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

constexpr int kCutColumns = 3;
constexpr int kCutRows = 160;
constexpr int kCutBegin = 95;  // rows on the plane
constexpr int kCutEnd = 105;

/// A level plane 0.495 m below a level camera. Row r falls by (r - 50) / 200 per metre, so row 94
/// (slope 0.22) meets the plane at 2.25 m and row 105 (0.275) at 1.8 m.
struct CutSurface {
  DepthWindow window;
  std::vector<Plane> planes{{.normal = {0, -1, 0}, .offset_m = 0.495F}};
  std::vector<std::uint8_t> plane_of_cell;

  CutSurface() {
    window.slope_x.assign(kCutColumns, 0.0F);
    for (int y = 0; y < kCutRows; ++y) {
      window.slope_y.push_back(static_cast<float>(y - 50) / 200.0F);
    }
    window.depth_m.assign(static_cast<std::size_t>(kCutColumns) * kCutRows, 2.0F);
    window.step_m.assign(window.size(), 0.06F);
    plane_of_cell.assign(window.size(), 0);
    fill(plane_of_cell, kCutBegin, kCutEnd, 1);
  }

  template <class Value>
  void fill(std::vector<Value>& values, int begin, int end, std::type_identity_t<Value> value) {
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(window.cell(0, begin)),
              values.begin() + static_cast<std::ptrdiff_t>(window.cell(0, end - 1)) + kCutColumns,
              value);
  }
  [[nodiscard]] bool is_given_back() const {
    const auto left = without_slices(window, planes, plane_of_cell);
    return std::count(left.begin(), left.end(), 0) == static_cast<std::ptrdiff_t>(left.size());
  }
  [[nodiscard]] bool is_kept() const {
    return without_slices(window, planes, plane_of_cell) == plane_of_cell;
  }
};

TEST(PlaneSlices, AnUprightSurfaceThatAPlaneCutsIsWholeAgain) {
  EXPECT_TRUE(CutSurface().is_given_back());
}

TEST(PlaneSlices, ASurfaceMayLeanByAQuarterOfThePlanesDepth) {
  CutSurface leaning;  // by 0.01 m a row: 0.11 m of the plane's 0.45 m
  for (int y = 0; y < kCutRows; ++y) {
    leaning.fill(
        leaning.window.depth_m, y, y + 1, 2.0F - 0.01F * static_cast<float>(y - kCutBegin));
  }
  EXPECT_TRUE(leaning.is_given_back());
  for (int y = 0; y < kCutRows; ++y) {  // 0.121 m
    leaning.fill(
        leaning.window.depth_m, y, y + 1, 2.0F - 0.011F * static_cast<float>(y - kCutBegin));
  }
  EXPECT_TRUE(leaning.is_kept());
}

TEST(PlaneSlices, ASeatThatAnUprightPlaneCutsIsWholeAgain) {
  CutSurface seat;  // a level one, which an upright plane meets 2 m away
  seat.planes = {{.normal = {0, 0, -1}, .offset_m = 2.0F}};
  for (int y = 60; y < kCutRows; ++y) {
    const float slope = static_cast<float>(y - 50) / 200.0F;
    seat.fill(seat.window.depth_m, y, y + 1, 0.495F / slope);
  }
  EXPECT_TRUE(seat.is_given_back());
}

TEST(PlaneSlices, ChangesThatAreLessThanNoiseTellNothing) {
  CutSurface cut;  // 0.45 m on the plane
  std::fill(cut.window.step_m.begin(), cut.window.step_m.end(), 1.49F);
  EXPECT_TRUE(cut.is_given_back());
  std::fill(cut.window.step_m.begin(), cut.window.step_m.end(), 1.51F);
  EXPECT_TRUE(cut.is_kept());
}

TEST(PlaneSlices, ATopBetweenItsFrontAndWhatStandsOnItIsItsOwn) {
  CutSurface table;
  table.fill(table.window.depth_m, 0, kCutBegin, 2.25F);      // a cup at the far edge
  table.fill(table.window.depth_m, kCutEnd, kCutRows, 1.8F);  // the front below the near edge
  for (int y = kCutBegin; y < kCutEnd; ++y) {
    const float slope = static_cast<float>(y - 50) / 200.0F;
    table.fill(table.window.depth_m, y, y + 1, 0.495F / slope);
  }
  EXPECT_TRUE(table.is_kept());
}

TEST(PlaneSlices, WhatEndsAtThePlaneIsNotCut) {
  CutSurface cut;
  cut.fill(cut.window.depth_m, kCutEnd, kCutRows, 1.5F);  // another surface, nearer
  EXPECT_TRUE(cut.is_kept());
  cut.fill(cut.window.depth_m, kCutEnd, kCutRows, 0.0F);  // nothing measured
  EXPECT_TRUE(cut.is_kept());
  cut.fill(cut.window.depth_m, kCutEnd, kCutRows, 2.0F);
  ASSERT_TRUE(cut.is_given_back());
  cut.fill(cut.plane_of_cell, kCutEnd, kCutRows, 2);  // another plane
  cut.planes.push_back({.normal = {0, 0, -1}, .offset_m = 2.0F});
  EXPECT_TRUE(cut.is_kept());
}

TEST(PlaneSlices, ARunUpToTheWindowsBorderIsKept) {
  for (const auto& [begin, end] : {std::pair(0, 40), {120, kCutRows}, {0, kCutRows}}) {
    CutSurface cut;
    std::fill(cut.plane_of_cell.begin(), cut.plane_of_cell.end(), std::uint8_t{0});
    cut.fill(cut.plane_of_cell, begin, end, 1);
    EXPECT_TRUE(cut.is_kept()) << begin;
  }
}

TEST(PlaneSlices, AboveTheHorizonNoPlaneBelowTheCameraIsSeen) {
  CutSurface cut;  // rows 20 to 30 look up
  std::fill(cut.plane_of_cell.begin(), cut.plane_of_cell.end(), std::uint8_t{0});
  cut.fill(cut.plane_of_cell, 20, 30, 1);
  EXPECT_TRUE(cut.is_given_back());
}

}  // namespace
}  // namespace hypermap

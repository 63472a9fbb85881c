// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/grid_patch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

/// 4 x 3 cells of 0.5 m from (1, 2), all free.
GridGeometry whole_geometry(double yaw_rad = 0.0) {
  return {.resolution_m = 0.5, .origin = {1, 2}, .yaw_rad = yaw_rad, .cols = 4, .rows = 3};
}

/// `cols` x `rows` cells from that cell of the whole on.
GridGeometry part_geometry(const GridGeometry& whole, Cell first, int cols, int rows) {
  GridGeometry part = whole;
  part.origin = from_cells(whole, {first.col, first.row});
  part.cols = cols;
  part.rows = rows;
  return part;
}

TEST(GridPatch, TakesThePlaceOfTheCellsUnderIt) {
  const OccupancyGrid whole = OccupancyGrid::create(whole_geometry(), kFreeCell).value();
  const OccupancyGrid part =
      OccupancyGrid::create({.resolution_m = 0.5, .origin = {1.5, 2.5}, .cols = 2, .rows = 2},
                            {100, -1, 7, 0})
          .value();
  const auto patch = patched(whole, part);
  ASSERT_TRUE(patch) << to_string(patch.error());
  EXPECT_EQ(patch->geometry(), whole.geometry());
  // Rows from the bottom: the first untouched, then 100 and unknown, then 7 and 0 in the middle.
  EXPECT_EQ(std::vector<std::int8_t>(patch->cells().begin(), patch->cells().end()),
            (std::vector<std::int8_t>{0, 0, 0, 0, 0, 100, -1, 0, 0, 7, 0, 0}));
}

TEST(GridPatch, OfATurnedGridLiesOnItsAxes) {
  const GridGeometry whole = whole_geometry(0.7);
  EXPECT_EQ(first_cell_of_part(whole, part_geometry(whole, {2, 1}, 2, 2)).value(),
            (Cell{.col = 2, .row = 1}));
  // A full turn more is none.
  GridGeometry turned = part_geometry(whole, {2, 1}, 2, 2);
  turned.yaw_rad += 2.0 * M_PI;
  EXPECT_EQ(first_cell_of_part(whole, turned).value(), (Cell{.col = 2, .row = 1}));
}

TEST(GridPatch, OfTheWholeGridReplacesIt) {
  const OccupancyGrid whole = OccupancyGrid::create(whole_geometry(0.1), kFreeCell).value();
  const OccupancyGrid other = OccupancyGrid::create(whole_geometry(0.1), kOccupiedCell).value();
  EXPECT_EQ(patched(whole, other).value(), other);
}

TEST(GridPatch, ReadsOriginsOfSixDigits) {
  const GridGeometry whole{
      .resolution_m = 0.05, .origin = {-12.3456789, 7.7654321}, .cols = 4000, .rows = 4000};
  GridGeometry part = part_geometry(whole, {1234, 777}, 100, 100);
  part.origin = {std::round(part.origin.x() * 1e5) / 1e5, std::round(part.origin.y() * 1e5) / 1e5};
  EXPECT_EQ(first_cell_of_part(whole, part).value(), (Cell{.col = 1234, .row = 777}));
}

std::string patch_refusal(const GridGeometry& part) {
  const auto fits = first_cell_of_part(whole_geometry(), part);
  return fits ? "none" : to_string(fits.error());
}

TEST(GridPatch, IsRefusedOffTheLatticeAndBeyondTheBounds) {
  const GridGeometry whole = whole_geometry();
  GridGeometry part = part_geometry(whole, {1, 1}, 2, 2);
  EXPECT_EQ(patch_refusal(part), "none");
  part.resolution_m = 0.51;
  EXPECT_EQ(patch_refusal(part), "resolution: is 0.51 m, that of the layer 0.5 m");
  part = part_geometry(whole, {1, 1}, 2, 2);
  part.yaw_rad = 0.01;
  EXPECT_EQ(patch_refusal(part), "yaw: is 0.01 rad, that of the layer 0 rad");
  part = part_geometry(whole, {1, 1}, 2, 2);
  part.origin.x() += 0.125;
  EXPECT_THAT(patch_refusal(part), HasSubstr("origin: lies 1.25, 1 cells from"));
  EXPECT_THAT(patch_refusal(part_geometry(whole, {3, 1}, 2, 2)),
              HasSubstr("bounds: reaches from column 3 to 4, the layer has 0 to 3"));
  EXPECT_THAT(patch_refusal(part_geometry(whole, {1, -1}, 2, 2)),
              HasSubstr("bounds: reaches from row -1 to 0, the layer has 0 to 2"));
  EXPECT_THAT(patch_refusal(part_geometry(whole, {1, 1}, 0, 2)), HasSubstr("has no cells"));
  EXPECT_THAT(patch_refusal(part_geometry(whole, {0, 0}, 5, 1)), HasSubstr("bounds: "));
  part.origin = {1e6, 1e6};
  part.resolution_m = whole.resolution_m;
  EXPECT_THAT(patch_refusal(part), HasSubstr("bounds: "));
}

TEST(GridPatch, ChangesNoCellBesideIt) {
  std::mt19937 random(3);
  const GridGeometry whole{
      .resolution_m = 0.1, .origin = {-3, 5}, .yaw_rad = -0.4, .cols = 30, .rows = 20};
  for (int round = 0; round < 50; ++round) {
    const auto pick = [&](int from, int to) {
      return std::uniform_int_distribution<int>(from, to)(random);
    };
    const Cell first{.col = pick(0, 29), .row = pick(0, 19)};
    const GridGeometry geometry =
        part_geometry(whole, first, pick(1, 30 - first.col), pick(1, 20 - first.row));
    const OccupancyGrid part = OccupancyGrid::create(geometry, kOccupiedCell).value();
    const OccupancyGrid patch =
        patched(OccupancyGrid::create(whole, kFreeCell).value(), part).value();
    for (int row = 0; row < whole.rows; ++row) {
      for (int col = 0; col < whole.cols; ++col) {
        const auto under = part.at_point(centre(whole, {.col = col, .row = row}));
        ASSERT_EQ(patch.at({.col = col, .row = row}), under.value_or(kFreeCell));
      }
    }
  }
}

}  // namespace
}  // namespace hypermap

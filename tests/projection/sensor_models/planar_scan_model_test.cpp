// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/planar_scan_model.hpp"

#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hypermap::test {
namespace {

RangeScan one_beam(double range_m, double x_m = 0.0, double y_m = 0.0, double yaw_rad = 0.0) {
  return {.map_from_scanner = MapFromScanner(placed(x_m, y_m, yaw_rad) * mounted(0.3)),
          .bearings_rad = {0.0},
          .ranges_m = {range_m}};
}

/// Cells of 1 m; the end lies within 0.25 m of the reading.
PlanarScanOptions metre_cells() {
  return {.evidence = {.resolution_m = 1.0}, .range_error_m = 0.25, .range_error_per_m = 0.0};
}

LogOddsGrid grid_of_scan(const RangeScan& scan, const PlanarScanOptions& options) {
  return PlanarScanModel::create(options).value().grids(scan).value().front().grid;
}

int steps_at(const LogOddsGrid& grid, double x_m, double y_m) {
  const auto cell = cell_at(grid.geometry(), {x_m, y_m});
  return cell ? grid.at(*cell) : 0;
}

TEST(PlanarScanModel, ABeamIsFreeByAreaAndOccupiedWhereItEnds) {
  // [sogm] III-B. From (0, 0.5) along y = 0.5, 0.2 rad wide, 3.5 m far. The cell [1, 2) x [0, 1) is
  // cut by the sector between x tan(-0.1) and x tan(0.1): area tan(0.1) (4 - 1) = 0.3010.
  PlanarScanOptions options = metre_cells();
  options.beam_width_rad = 0.2;
  const LogOddsGrid grid = grid_of_scan(one_beam(3.5, 0.0, 0.5), options);
  EXPECT_NEAR(steps_at(grid, 1.5, 0.5), 0.3010 * kFree, 1.0);
  // The end, of 3.25 to 3.75 m, lies in the cell [3, 4) x [0, 1) as a whole: all of it counts,
  // however narrow it is, and nothing of the free part before it.
  EXPECT_EQ(steps_at(grid, 3.5, 0.5), kHit);
  EXPECT_EQ(steps_at(grid, 4.5, 0.5), 0);
  EXPECT_EQ(steps_at(grid, 1.5, 1.5), 0);
}

TEST(PlanarScanModel, AnEndAcrossAnEdgeIsSharedOut) {
  // The end of 2.9 m +- 0.25 is in [2, 3) for 0.35 / 0.5 = 0.7 and in [3, 4) for 0.3; the beam is
  // so narrow that its arcs are lines. Before the end 0.65 m of the cell are free, 0.02 x 2.33 m.
  PlanarScanOptions options = metre_cells();
  options.beam_width_rad = 0.02;
  const LogOddsGrid grid = grid_of_scan(one_beam(2.9, 0.0, 0.5), options);
  const double ring = (3.0 * 3.0 - 2.65 * 2.65) / (3.15 * 3.15 - 2.65 * 2.65);
  const double width = 2.9 * 0.02;  // of the end, as it is counted
  const double in_cell = (3.0 * 3.0 - 2.65 * 2.65) / 2.0 * 0.02 / (0.5 * width);
  EXPECT_NEAR(ring, in_cell, 0.03);
  const double free = (2.65 * 2.65 - 2.0 * 2.0) / 2.0 * 0.02;
  EXPECT_NEAR(steps_at(grid, 2.5, 0.5), in_cell * kHit + (1.0 - in_cell) * free * kFree, 1.0);
  const double beyond = (3.15 * 3.15 - 3.0 * 3.0) / 2.0 * 0.02 / (0.5 * width);
  EXPECT_NEAR(steps_at(grid, 3.5, 0.5), beyond * kHit, 1.0);
}

TEST(PlanarScanModel, AnUncertainEndSaysNoMoreInAll) {
  // 4 m long in cells of 1 m: each of four cells has a quarter.
  PlanarScanOptions options = metre_cells();
  options.range_error_m = 2.0;
  options.beam_width_rad = 0.5;  // 5 m wide at 10 m: cells in the middle are covered whole
  const LogOddsGrid grid = grid_of_scan(one_beam(10.0, 0.0, 0.5), options);
  EXPECT_NEAR(steps_at(grid, 9.5, 0.5), kHit / 4.0, 1.0);
  EXPECT_NEAR(steps_at(grid, 10.5, 0.5), kHit / 4.0, 1.0);
}

TEST(PlanarScanModel, TheErrorGrowsWithTheRange) {
  PlanarScanOptions options = metre_cells();
  options.range_error_per_m = 0.175;  // 0.25 + 10 x 0.175 = 2 m
  options.beam_width_rad = 0.5;
  const LogOddsGrid grid = grid_of_scan(one_beam(10.0, 0.0, 0.5), options);
  EXPECT_NEAR(steps_at(grid, 9.5, 0.5), kHit / 4.0, 1.0);
}

TEST(PlanarScanModel, NoCellBetweenBeamsIsLeftOutFarAway) {
  // Beams of 0.05 rad are 1 m apart at 20 m, twenty cells of 5 cm.
  RangeScan scan{
      .map_from_scanner = MapFromScanner(mounted(0.3)), .bearings_rad = {}, .ranges_m = {}};
  for (int i = -10; i <= 10; ++i) {
    scan.bearings_rad.push_back(i * 0.05);
    scan.ranges_m.push_back(20.0);
  }
  const LogOddsGrid grid = grid_of_scan(scan, {});
  std::size_t num_checked = 0;
  for (int i = -480; i <= 480; ++i) {
    const double bearing = i * 0.001;
    for (const double range : {5.0, 12.3, 19.0}) {
      const int steps = steps_at(grid, range * std::cos(bearing), range * std::sin(bearing));
      ASSERT_EQ(steps, kFree) << bearing << ' ' << range;
      ++num_checked;
    }
    ASSERT_GT(steps_at(grid, 20.0 * std::cos(bearing), 20.0 * std::sin(bearing)), 0) << bearing;
  }
  EXPECT_EQ(num_checked, 3U * 961U);
}

TEST(PlanarScanModel, AFullTurnHasNoGapWhereItCloses) {
  RangeScan scan{
      .map_from_scanner = MapFromScanner(mounted(0.3)), .bearings_rad = {}, .ranges_m = {}};
  for (int i = 0; i < 180; ++i) {
    scan.bearings_rad.push_back(i * 2.0 * std::numbers::pi / 180.0);
    scan.ranges_m.push_back(5.0);
  }
  const LogOddsGrid grid = grid_of_scan(scan, {});
  for (int i = 0; i < 2000; ++i) {
    const double bearing = i * std::numbers::pi / 1000.0;
    ASSERT_EQ(steps_at(grid, 3.0 * std::cos(bearing), 3.0 * std::sin(bearing)), kFree) << bearing;
  }
}

TEST(PlanarScanModel, AWideGapBetweenBeamsStaysUnknown) {
  const RangeScan scan{.map_from_scanner = MapFromScanner(mounted(0.3)),
                       .bearings_rad = {-0.5, 0.5},
                       .ranges_m = {4.0, 4.0}};
  const LogOddsGrid grid = grid_of_scan(scan, {});
  EXPECT_EQ(steps_at(grid, 2.0, 0.0), 0);
  EXPECT_LT(steps_at(grid, 2.0 * std::cos(0.5), 2.0 * std::sin(0.5)), 0);
}

TEST(PlanarScanModel, AThinPoleIsNotOutvotedByBeamsThatPassIt) {
  // One beam of 11 ends at 1 m; the others pass it. Cells of 0.25 m hold seven beams' widths.
  RangeScan scan{.map_from_scanner = MapFromScanner(placed(0.0, 0.125) * mounted(0.3)),
                 .bearings_rad = {},
                 .ranges_m = {}};
  for (int i = -5; i <= 5; ++i) {
    scan.bearings_rad.push_back(i * 0.02);
    scan.ranges_m.push_back(i == 0 ? 1.125 : 3.0);
  }
  const LogOddsGrid grid = grid_of_scan(scan, {.evidence = {.resolution_m = 0.25}});
  EXPECT_EQ(steps_at(grid, 1.125, 0.125), kHit);
}

TEST(PlanarScanModel, AWallJustBehindAnEdgeLeavesTheCellBeforeItFree) {
  // 2.02 +- 0.03: a sixth of the end lies before x = 2, of 0.1 m free 0.09.
  RangeScan scan{
      .map_from_scanner = MapFromScanner(mounted(0.3)), .bearings_rad = {}, .ranges_m = {}};
  for (int i = -30; i <= 30; ++i) {
    scan.bearings_rad.push_back(i * 0.01);
    scan.ranges_m.push_back(2.02 / std::cos(i * 0.01));
  }
  const LogOddsGrid grid = grid_of_scan(
      scan, {.evidence = {.resolution_m = 0.1}, .range_error_m = 0.03, .range_error_per_m = 0.0});
  EXPECT_LT(steps_at(grid, 1.95, 0.05), 0);
  EXPECT_GT(steps_at(grid, 2.05, 0.05), 0);
}

TEST(PlanarScanModel, WhatMetNothingSaysWhatIsAskedFor) {
  const RangeScan scan = one_beam(kNoReading, 0.0, 0.5);
  PlanarScanOptions options = metre_cells();
  options.beam_width_rad = 0.2;
  options.max_range_m = 3.0;
  EXPECT_EQ(grid_of_scan(scan, options).num_known(), 0U);
  options.no_return = NoReturnRule::kFree;
  const LogOddsGrid grid = grid_of_scan(scan, options);
  EXPECT_NEAR(steps_at(grid, 1.5, 0.5), 0.3010 * kFree, 1.0);
  EXPECT_EQ(steps_at(grid, 3.5, 0.5), 0);
  for (const LogOddsSteps steps : grid.cells()) EXPECT_LE(steps, 0);
}

TEST(PlanarScanModel, ReadingsThatAreNoneSayNothing) {
  PlanarScanOptions options;
  options.no_return = NoReturnRule::kFree;
  for (const double none : {std::nan(""), -2.0, 0.0, 0.01, -kNoReading}) {
    EXPECT_EQ(grid_of_scan(one_beam(none), options).num_known(), 0U) << none;
  }
}

TEST(PlanarScanModel, BeamsMayComeInAnyOrder) {
  RangeScan scan = scan_of_wall(mounted(0.5), placed(0.0, 0.0));
  const LogOddsGrid forwards = grid_of_scan(scan, {});
  std::ranges::reverse(scan.bearings_rad);
  std::ranges::reverse(scan.ranges_m);
  EXPECT_EQ(grid_of_scan(scan, {}), forwards);
  for (double& bearing : scan.bearings_rad) bearing += 2.0 * std::numbers::pi;
  const LogOddsGrid turned = grid_of_scan(scan, {});
  ASSERT_EQ(turned.geometry(), forwards.geometry());
  for (std::size_t i = 0; i < forwards.cells().size(); ++i) {
    EXPECT_NEAR(turned.cells()[i], forwards.cells()[i], 1);
  }
}

TEST(PlanarScanModel, AScanThatBreaksItsRulesIsRefused) {
  const PlanarScanModel model = PlanarScanModel::create().value();
  RangeScan scan = one_beam(1.0);
  scan.ranges_m.push_back(2.0);
  EXPECT_EQ(model.grids(scan).error().field, "ranges_m");
  scan = one_beam(1.0);
  scan.bearings_rad = {std::nan("")};
  EXPECT_EQ(model.grids(scan).error().field, "bearings_rad");
  scan = one_beam(1.0);
  scan.map_from_scanner = MapFromScanner(mounted(0.3, 0.2));
  EXPECT_EQ(model.grids(scan).error().field, "map_from_scanner");
  EXPECT_EQ(validate(PlanarScanOptions{.min_range_m = 3.0, .max_range_m = 2.0}).error().field,
            "max_range_m");
}

TEST(PlanarScanModel, TooManyCellsAreALimit) {
  const PlanarScanModel model =
      PlanarScanModel::create({.evidence = {.resolution_m = 0.001}, .max_range_m = 1000.0}).value();
  EXPECT_EQ(model.grids(one_beam(900.0)).error().code, ErrorCode::kLimit);
}

}  // namespace
}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/tilted_scan_model.hpp"

#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hypermap::test {
namespace {

/// One beam from 0.6 m above (0, 0), down by asin(0.6) = 0.6435 rad: 0.8 m on for each 1 m.
RangeScan steep(const std::vector<double>& ranges_m) {
  return {.map_from_scanner = MapFromScanner(placed(0.0, 0.0) * mounted(0.6, std::asin(0.6))),
          .bearings_rad = std::vector<double>(ranges_m.size(), 0.0),
          .ranges_m = ranges_m};
}

LogOddsGrid grid_of_tilted(const RangeScan& scan) {
  return TiltedScanModel::create().value().grids(scan).value().front().grid;
}

TEST(TiltedScanModel, TheGroundIsFreeWhereTheBeamEndsAlone) {
  const LogOddsGrid grid = grid_of_tilted(steep({1.0}));  // ends at (0.8, 0, 0)
  EXPECT_EQ(grid.num_known(), 1U);
  EXPECT_EQ(grid.at(cell_at(grid.geometry(), {0.81, 0.01}).value()), kFree);
}

TEST(TiltedScanModel, WhatIsHigherIsAnObstacle) {
  const LogOddsGrid grid = grid_of_tilted(steep({0.77}));  // at (0.616, 0, 0.138)
  EXPECT_EQ(grid.num_known(), 1U);
  EXPECT_EQ(grid.at(cell_at(grid.geometry(), {0.616, 0.01}).value()), kHit);
}

TEST(TiltedScanModel, HolesAndCeilingsSayNothing) {
  EXPECT_EQ(grid_of_tilted(steep({1.2})).num_known(), 0U);  // 0.12 m below the ground
  const RangeScan up{.map_from_scanner = MapFromScanner(mounted(0.6, -std::asin(0.6))),
                     .bearings_rad = {0.0},
                     .ranges_m = {2.1}};  // 1.86 m high
  EXPECT_EQ(grid_of_tilted(up).num_known(), 0U);
}

TEST(TiltedScanModel, ACellIsToldOnceAndObstaclesWin) {
  // 1.0 m ends on the ground at x = 0.8; 0.94 m at (0.752, 0, 0.036), ground too, in the same cell
  // of 0.05 m as 0.9376 m would be; a tolerance of 1 cm makes an obstacle of it.
  const TiltedScanModel model = TiltedScanModel::create({.evidence = {.resolution_m = 0.1},
                                                         .heights = {.ground_tolerance_m = 0.05}})
                                    .value();
  const auto says = [&](const std::vector<double>& ranges_m) {
    return model.grids(steep(ranges_m)).value().front().grid;
  };
  // Both in [0.7, 0.8): 0.99 m at x = 0.792, z = 0.006; 0.9 m at x = 0.72, z = 0.06.
  for (const LogOddsGrid& grid : {says({0.99, 0.9}), says({0.9, 0.99})}) {
    EXPECT_EQ(grid.num_known(), 1U);
    EXPECT_EQ(grid.at(cell_at(grid.geometry(), {0.75, 0.01}).value()), kHit);
  }
  const LogOddsGrid twice = says({0.99, 0.98});
  EXPECT_EQ(twice.at(cell_at(twice.geometry(), {0.75, 0.01}).value()), kFree);
}

TEST(TiltedScanModel, OptionsAreChecked) {
  EXPECT_EQ(validate(TiltedScanOptions{.min_range_m = 3.0, .max_range_m = 2.0}).error().field,
            "max_range_m");
  EXPECT_EQ(validate(TiltedScanOptions{.evidence = {.resolution_m = 0.0}}).error().field,
            "evidence.resolution_m");
}

}  // namespace
}  // namespace hypermap::test

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/sensor_models/depth_camera_model.hpp"

#include "sensor_worlds.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hypermap::test {
namespace {

LogOddsGrid grid_of_depth(const RgbdFrame& frame, const DepthCameraOptions& options = {}) {
  return DepthCameraModel::create(options).value().grids(frame).value().front().grid;
}

int depth_at(const LogOddsGrid& grid, double x_m, double y_m) {
  const auto cell = cell_at(grid.geometry(), {x_m, y_m});
  return cell ? grid.at(*cell) : 0;
}

TEST(DepthCameraModel, GroundIsFreeWithoutGapsAndTheWallOccupied) {
  // Far from this camera a pixel's ground is longer than a cell of 2 cm.
  const LogOddsGrid grid =
      grid_of_depth(frame_of_wall(placed(0.0, 0.0)), {.evidence = {.resolution_m = 0.02}});
  // The last pixels before the wall measure its foot, below the tolerance of 5 cm.
  for (double x = 0.9; x < 2.0; x += 0.005) {
    ASSERT_EQ(depth_at(grid, x, 0.101), kFree) << x;
  }
  EXPECT_EQ(depth_at(grid, kWallFrontM + 0.001, 0.101), kHit);
  EXPECT_EQ(depth_at(grid, 2.3, 0.101), 0);
}

TEST(DepthCameraModel, WhatStandsOnTheGroundHidesIt) {
  RgbdFrame frame = frame_of_wall(placed(0.0, 0.0));
  const PixelPoint spot = pixel_of(1.3, 0.0, 0.0);
  const int u = static_cast<int>(std::lround(spot.u_px));
  const int v = static_cast<int>(std::lround(spot.v_px));
  for (int dv = -2; dv <= 2; ++dv) {
    for (int du = -2; du <= 2; ++du) frame.depth_m.at(u + du, v + dv) *= 0.8F;  // 0.24 m high
  }
  const LogOddsGrid grid = grid_of_depth(frame);
  EXPECT_EQ(depth_at(grid, 1.31, 0.01), 0);                  // behind it
  EXPECT_EQ(depth_at(grid, 1.3 * 0.8 + 0.005, 0.01), kHit);  // where it is: 0.8 of the way
}

/// Occupied cells before the wall.
int num_hit_before_wall(const LogOddsGrid& grid) {
  int num_hit = 0;
  for (int row = 0; row < grid.geometry().rows; ++row) {
    for (int col = 0; col < grid.geometry().cols; ++col) {
      const bool is_before = centre(grid.geometry(), {col, row}).x() < 1.9;
      num_hit += is_before && grid.at({col, row}) > 0 ? 1 : 0;
    }
  }
  return num_hit;
}

TEST(DepthCameraModel, FewPixelsAreNoObstacle) {
  RgbdFrame frame = frame_of_wall(placed(0.0, 0.0));
  const PixelPoint spot = pixel_of(1.3, 0.0, 0.0);
  frame.depth_m.at(static_cast<int>(std::lround(spot.u_px)),
                   static_cast<int>(std::lround(spot.v_px))) *= 0.8F;
  EXPECT_EQ(num_hit_before_wall(grid_of_depth(frame)), 0);
  EXPECT_EQ(num_hit_before_wall(grid_of_depth(frame, {.min_obstacle_px = 1})), 1);
}

TEST(DepthCameraModel, TheBandOfHeightsIsAskedFor) {
  DepthCameraOptions options;
  options.heights.ground_m = -0.5;  // the floor is 0.5 m above the ground: an obstacle
  EXPECT_EQ(depth_at(grid_of_depth(frame_of_wall(placed(0.0, 0.0)), options), 1.31, 0.01), kHit);
  options.heights.max_obstacle_m = 0.4;  // and now too high to be one
  EXPECT_EQ(grid_of_depth(frame_of_wall(placed(0.0, 0.0)), options).num_known(), 0U);
}

TEST(DepthCameraModel, BeyondItsRangeNothingIsKnown) {
  const LogOddsGrid grid = grid_of_depth(frame_of_wall(placed(0.0, 0.0)), {.max_range_m = 1.5});
  EXPECT_EQ(depth_at(grid, 1.41, 0.01), kFree);
  EXPECT_EQ(depth_at(grid, 1.61, 0.01), 0);
  EXPECT_EQ(depth_at(grid, kWallFrontM + 0.001, 0.01), 0);
}

TEST(DepthCameraModel, AFrameWithoutDepthOrFromBelowKnowsNothing) {
  RgbdFrame frame = frame_of_wall(placed(0.0, 0.0));
  DepthCameraOptions above;
  above.heights.ground_m = 5.0;
  EXPECT_EQ(grid_of_depth(frame, above).num_known(), 0U);
  EXPECT_EQ(validate(DepthCameraOptions{.min_obstacle_px = 0}).error().field, "min_obstacle_px");
}

}  // namespace
}  // namespace hypermap::test

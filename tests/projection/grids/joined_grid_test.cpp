// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/grids/joined_grid.hpp"

#include "hypermap/projection/grids/cropped_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace hypermap {
namespace {

/// Turned, of known cells alone.
OccupancyGrid noise_grid() {
  std::mt19937 engine(3);
  std::uniform_int_distribution<int> value(0, 100);
  const GridGeometry geometry{
      .resolution_m = 0.1, .origin = {-1.3, 2.7}, .yaw_rad = 0.4, .cols = 23, .rows = 17};
  std::vector<std::int8_t> cells(geometry.num_cells());
  for (std::int8_t& cell : cells) cell = static_cast<std::int8_t>(value(engine));
  return OccupancyGrid::create(geometry, cells).value();
}

TEST(JoinedGrid, PartsAreTheWholeAgainInAnyOrder) {
  const OccupancyGrid whole = noise_grid();
  std::vector<OccupancyGrid> parts;
  for (const int quarter : {2, 0, 3, 1}) {
    parts.push_back(cropped(whole, [&](const Eigen::Vector2d& at) {
      return (at.x() < -0.8) == (quarter % 2 == 0) && (at.y() < 3.5) == (quarter < 2);
    }));
  }
  const auto again = joined(parts);
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_THAT(again->cells(), testing::ElementsAreArray(whole.cells()));
  EXPECT_EQ(again->geometry().cols, 23);
  EXPECT_LT((again->geometry().origin - whole.geometry().origin).norm(), 1e-9);
}

TEST(JoinedGrid, WhatNoPartKnowsIsUnknown) {
  const OccupancyGrid one =
      OccupancyGrid::create({.resolution_m = 1, .origin = {0, 0}, .cols = 1, .rows = 1}, 7).value();
  const OccupancyGrid two =
      OccupancyGrid::create({.resolution_m = 1, .origin = {2, -1}, .cols = 1, .rows = 1}, 9)
          .value();
  const OccupancyGrid both = joined(std::vector{one, two}).value();
  EXPECT_THAT(both.cells(), testing::ElementsAre(-1, -1, 9, 7, -1, -1));
  EXPECT_EQ(both.geometry().origin, Eigen::Vector2d(0, -1));
  EXPECT_EQ(joined({}).value().geometry().num_cells(), 0U);
}

TEST(JoinedGrid, PartsOfOtherLatticesAndCellsTwiceAreRefused) {
  const auto grid = [](const GridGeometry& geometry) {
    return OccupancyGrid::create(geometry, kFreeCell).value();
  };
  const auto refusal = [&](const GridGeometry& other) {
    const OccupancyGrid first = grid({.resolution_m = 1, .cols = 2, .rows = 2});
    const auto result = joined(std::vector{first, grid(other)});
    return result ? "none" : to_string(result.error());
  };
  using testing::HasSubstr;
  EXPECT_EQ(refusal({.resolution_m = 1, .origin = {2, 0}, .cols = 2, .rows = 2}), "none");
  EXPECT_THAT(refusal({.resolution_m = 2, .origin = {2, 0}, .cols = 2, .rows = 2}),
              HasSubstr("resolution and turn"));
  EXPECT_THAT(refusal({.resolution_m = 1, .origin = {2, 0}, .yaw_rad = 0.1, .cols = 2, .rows = 2}),
              HasSubstr("resolution and turn"));
  EXPECT_THAT(refusal({.resolution_m = 1, .origin = {2.5, 0}, .cols = 2, .rows = 2}),
              HasSubstr("lattice"));
  EXPECT_THAT(refusal({.resolution_m = 1, .origin = {1, 0}, .cols = 2, .rows = 2}),
              HasSubstr("another part knows"));
  EXPECT_THAT(refusal({.resolution_m = 1, .origin = {90000, 0}, .cols = 2, .rows = 2}),
              HasSubstr("65535"));
}

}  // namespace
}  // namespace hypermap

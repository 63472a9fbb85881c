// SPDX-License-Identifier: BSD-3-Clause
// What a moving region refuses, and that it stays as it was then.
#include "hypermap/projection/tiles/moving_region.hpp"
#include "region_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>

namespace hypermap {
namespace {

using test::grid_of;
using test::MemoryStore;
using test::metre_tiles;
using test::pose;
using test::random_grid;
using test::reading;
using test::region_at;
using test::sized;
using test::StoredTiles;
using testing::HasSubstr;

TEST(MovingRegionRefusals, AStoreThatFailsLeavesTheRegionAsItWas) {
  const auto stored = std::make_shared<StoredTiles>();
  MovingRegion region = region_at(0.5, 0.5, stored);
  ASSERT_TRUE(region.fuse(reading(random_grid(sized(50, 30), 1, 500)), pose(-2, -1)));
  const GridStack before = region.stack();
  const TileFrame frame = region.frame();
  stored->puts_until_failure = 2;
  const auto full = region.follow({9, 9});
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error().what, "the disk is full");
  stored->fails_to_get = true;
  EXPECT_EQ(region.follow({9, 9}).error().what, "the disk is gone");
  EXPECT_EQ(region.stack(), before);
  EXPECT_EQ(region.frame(), frame);
  EXPECT_FALSE(region.last_stack());
  // It goes on where it can be stored again; what was put already is not put twice.
  stored->fails_to_get = false;
  stored->puts_until_failure = -1;
  EXPECT_EQ(region.follow({9, 9}).value()->num_stored, 13U);
  EXPECT_EQ(stored->tiles.size(), 15U);
}

TEST(MovingRegionRefusals, WhatCannotBeFusedLeavesTheStackAsItWas) {
  MovingRegion region = region_at(0.5, 0.5, std::make_shared<StoredTiles>());
  ASSERT_TRUE(region.fuse(reading(random_grid(sized(5, 5), 1, 500)), pose(0, 0)));
  const GridStack before = region.stack();
  const LogOddsGrid one = grid_of(sized(1, 1), {1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(region.fuse(reading(LogOddsGrid()), pose(0, 0)));
  EXPECT_THAT(region.fuse(reading(one), pose(50, 0)).error().what, HasSubstr("lies outside"));
  EXPECT_FALSE(region.fuse(reading(one), pose(nan, 0)));
  EXPECT_FALSE(region.fuse(reading(one, "/other"), pose(0, 0)));
  for (const double bad : {nan, std::numeric_limits<double>::infinity(), 2e6}) {
    EXPECT_EQ(region.follow({bad, 0}).error().code, ErrorCode::kInvalidArgument);
  }
  EXPECT_EQ(region.stack(), before);
}

TEST(MovingRegionRefusals, OptionsAreChecked) {
  const auto field_of = [](const MovingRegionOptions& options) {
    const auto made = MovingRegion::create(
        {0, 0},
        std::make_unique<MemoryStore>(metre_tiles(), std::make_shared<StoredTiles>()),
        options);
    return made ? std::string() : made.error().field;
  };
  EXPECT_EQ(field_of({.inner_margin_m = 1.0}), "");
  EXPECT_EQ(field_of({.inner_margin_m = 1.01}), "inner_margin_m");
  EXPECT_EQ(field_of({.inner_margin_m = -0.1}), "inner_margin_m");
  EXPECT_EQ(field_of({.tile_cols = 0, .inner_margin_m = 0}), "tile_cols");
  EXPECT_EQ(field_of({.tile_rows = 1001, .inner_margin_m = 0}), "tile_rows");
  EXPECT_EQ(field_of({.tile_cols = 1000, .tile_rows = 1000, .inner_margin_m = 0}), "");
  EXPECT_EQ(field_of({.inner_margin_m = 0, .stack = {.keep_share = 2}}), "stack.keep_share");
  EXPECT_EQ(field_of({.inner_margin_m = 0, .stack = {.frame_id = "unasked"}}), "");
}

TEST(MovingRegionRefusals, ATileThatTheOptionsDoNotAllowIsRefused) {
  const auto stored = std::make_shared<StoredTiles>();
  {
    MovingRegion region = region_at(0.5, 0.5, stored);
    ASSERT_TRUE(region.fuse(reading(grid_of(sized(1, 1), {9000})), pose(0, 0)));
    ASSERT_TRUE(region.store_changes());
  }
  const auto made =
      MovingRegion::create({0.5, 0.5},
                           std::make_unique<MemoryStore>(metre_tiles(), stored),
                           {.inner_margin_m = 0, .stack = {.max_log_odds = LogOdds(3.0)}});
  ASSERT_FALSE(made);
  EXPECT_THAT(to_string(made.error()), HasSubstr("at most 3"));
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/tile_lattice.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

TEST(TileLattice, TilesLieSideBySideFromTheOrigin) {
  // 4 cells of 0.25 m: tile 2 begins at 2 m, tile -3 at -3 m.
  const TileLattice lattice{.resolution_m = 0.25, .tile_cells = 4};
  const auto geometry =
      geometry_of(lattice, {.first = {.col = 2, .row = -3}, .cols = 2, .rows = 3}).value();
  EXPECT_EQ(geometry.origin, Eigen::Vector2d(2, -3));
  EXPECT_EQ(geometry.cols, 8);
  EXPECT_EQ(geometry.rows, 12);
  EXPECT_EQ(geometry.resolution_m, 0.25);
  EXPECT_EQ(geometry.yaw_rad, 0.0);
}

TEST(TileLattice, PlacesAreOneProductOfWholeCells) {
  // A million steps of 0.1 m added up are off by 1e-6 m and more.
  const TileLattice lattice{.resolution_m = 0.1, .tile_cells = 1};
  double added_up = 0.0;
  for (int i = 0; i < 1'000'000; ++i) added_up += 0.1;
  const auto geometry = geometry_of(lattice, {.first = {.col = 1'000'000, .row = 3}}).value();
  EXPECT_EQ(geometry.origin.x(), 1'000'000 * 0.1);
  EXPECT_NE(geometry.origin.x(), added_up);
}

TEST(TileLattice, TheWindowAroundAPointHasItInItsMiddleTile) {
  const TileLattice lattice{.resolution_m = 0.5, .tile_cells = 4};  // tiles of 2 m
  const auto first = [&](double x, double y, int cols, int rows) {
    return window_around(lattice, {x, y}, cols, rows).value().first;
  };
  EXPECT_EQ(first(1, 1, 3, 3), (TileIndex{-1, -1}));
  EXPECT_EQ(first(-0.5, 5.9, 3, 3), (TileIndex{-2, 1}));
  // An even window: the middle is a corner, the nearest one.
  EXPECT_EQ(first(0.9, 3.1, 2, 2), (TileIndex{-1, 1}));
  // On the border between two windows the upper one; just below it the lower one.
  EXPECT_EQ(first(2, 1, 1, 1), (TileIndex{1, 0}));
  EXPECT_EQ(first(std::nextafter(2.0, 0.0), 1, 1, 1), (TileIndex{0, 0}));
}

TEST(TileLattice, AWindowContainsItsTilesAlone) {
  const TileWindow window{.first = {-1, 4}, .cols = 2, .rows = 1};
  EXPECT_TRUE(window.contains({-1, 4}));
  EXPECT_TRUE(window.contains({0, 4}));
  for (const TileIndex outside :
       {TileIndex{1, 4}, TileIndex{-2, 4}, TileIndex{0, 5}, TileIndex{0, 3}}) {
    EXPECT_FALSE(window.contains(outside));
  }
  // Differences of indices do not overflow.
  constexpr auto kLowest = std::numeric_limits<std::int32_t>::min();
  constexpr auto kHighest = std::numeric_limits<std::int32_t>::max();
  EXPECT_FALSE((TileWindow{.first = {kLowest, kLowest}}.contains({kHighest, kHighest})));
}

TEST(TileLattice, WhatIsNoLatticeOrTooFarIsRefused) {
  const auto field_of = [](const TileLattice& lattice) {
    const auto checked = validate(lattice);
    return checked ? std::string() : checked.error().field;
  };
  EXPECT_EQ(field_of({}), "");
  EXPECT_EQ(field_of({.frame_id = ""}), "frame_id");
  EXPECT_EQ(field_of({.frame_id = std::string(257, 'f')}), "frame_id");
  EXPECT_EQ(field_of({.resolution_m = 0.0}), "resolution");
  EXPECT_EQ(field_of({.resolution_m = std::numeric_limits<double>::quiet_NaN()}), "resolution");
  EXPECT_EQ(field_of({.tile_cells = 0}), "tile_cells");
  EXPECT_EQ(field_of({.tile_cells = 4097}), "tile_cells");

  const TileLattice fine{.resolution_m = 1e-6, .tile_cells = 1};
  EXPECT_EQ(window_around(fine, {1e5, 0}, 1, 1).error().code, ErrorCode::kLimit);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1e300, -1.1e6}) {
    EXPECT_EQ(window_around({}, {bad, 0}, 3, 3).error().code, ErrorCode::kInvalidArgument) << bad;
  }
  EXPECT_EQ(geometry_of({.tile_cells = 4096}, {.cols = 1000, .rows = 1000}).error().code,
            ErrorCode::kLimit);
  EXPECT_FALSE(geometry_of({}, {.first = {2'000'000'000, 0}}));
}

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/stored_map.hpp"

#include "memory_store.hpp"
#include "projection/stack/grid_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace hypermap {
namespace {

using test::MemoryStore;
using test::metre_tiles;
using test::pose;
using test::random_grid;
using test::StoredTiles;
using testing::HasSubstr;

/// Two layers of 37 x 25 cells, from (-1.3, 0.4) on.
GridStack random_stack() {
  const GridGeometry geometry{.resolution_m = 0.1, .origin = {-1.3, 0.4}, .cols = 37, .rows = 25};
  GridStack stack = GridStack::create(geometry).value();
  for (const auto& [layer, seed] : {std::pair{"/ism/a", 1}, {"/ism/b/c", 2}}) {
    EXPECT_TRUE(
        stack.replace_cells(layer, random_grid(geometry, static_cast<std::uint64_t>(seed), 5000)));
  }
  return stack;
}

TEST(StoredMap, AStackComesBackCellByCell) {
  MemoryStore store(metre_tiles(), std::make_shared<StoredTiles>());
  const GridStack stack = random_stack();
  // Columns -13 .. 23 lie in tiles -2 .. 2, rows 4 .. 28 in tiles 0 .. 2.
  EXPECT_EQ(store_stack(stack, store).value(), 15U);
  EXPECT_EQ(store.list().value().front(), (TileIndex{-2, 0}));
  const Rect area = bounds(stack.geometry());
  const GridStack back = stack_of_tiles(store, area).value();
  EXPECT_EQ(back.layers().at("/ism/a").cells().size(), 37U * 25U);
  EXPECT_EQ(std::vector(back.layers().at("/ism/a").cells().begin(),
                        back.layers().at("/ism/a").cells().end()),
            std::vector(stack.layers().at("/ism/a").cells().begin(),
                        stack.layers().at("/ism/a").cells().end()));
  EXPECT_EQ(back.layers().size(), 2U);
  const GridStack all = stack_of_tiles(store).value();
  EXPECT_EQ(all.geometry().origin, Eigen::Vector2d(-2, 0));
  EXPECT_EQ(all.geometry().cols, 50);
  EXPECT_EQ(all.geometry().rows, 30);
  for (const auto& [name, grid] : all.layers()) {
    EXPECT_EQ(grid.num_known(), stack.layers().at(name).num_known());
    EXPECT_EQ(grid.at({20, 10}), stack.layers().at(name).at({13, 6}));
  }
}

TEST(StoredMap, AnAreaHasTheCellsThatMeetIt) {
  MemoryStore store(metre_tiles(), std::make_shared<StoredTiles>());
  ASSERT_TRUE(store_stack(random_stack(), store));
  // 0.05 .. 0.31 meets columns 0 .. 3; 1.0 .. 1.2, on edges of cells, rows 10 and 11.
  const GridStack part = stack_of_tiles(store, Rect{{0.05, 1.0}, {0.31, 1.2}}).value();
  EXPECT_EQ(part.geometry().origin, Eigen::Vector2d(0, 1));
  EXPECT_EQ(part.geometry().cols, 4);
  EXPECT_EQ(part.geometry().rows, 2);
  const GridStack all = stack_of_tiles(store).value();
  for (int row = 0; row < 2; ++row) {
    for (int col = 0; col < 4; ++col) {
      EXPECT_EQ(part.layers().at("/ism/a").at({col, row}),
                all.layers().at("/ism/a").at({col + 20, row + 10}));
    }
  }
  // Beyond what is stored everything is unknown.
  const GridStack wide = stack_of_tiles(store, Rect{{-9, -9}, {9, 9}}).value();
  EXPECT_EQ(wide.layers().at("/ism/a").num_known(), all.layers().at("/ism/a").num_known());
}

TEST(StoredMap, WhatIsTooLargeOrNowhereIsRefusedByNumbers) {
  const auto stored = std::make_shared<StoredTiles>();
  MemoryStore store(metre_tiles(), stored);
  EXPECT_EQ(stack_of_tiles(store).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(store_stack(random_stack(), store));
  EXPECT_EQ(stack_of_tiles(store, Rect{{50, 50}, {51, 51}}).error().code, ErrorCode::kNotFound);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Rect& bad : {Rect{{0, 0}, {0, 1}},
                          Rect{{1, 0}, {0, 1}},
                          Rect{{nan, 0}, {1, 1}},
                          Rect{{0, 0}, {std::numeric_limits<double>::infinity(), 1}}}) {
    EXPECT_EQ(stack_of_tiles(store, bad).error().code, ErrorCode::kInvalidArgument);
  }
  // Two tiles 80 km apart.
  ASSERT_TRUE(store.put({.index = {80'000, 0}}));
  const auto far = stack_of_tiles(store);
  ASSERT_FALSE(far);
  EXPECT_EQ(far.error().code, ErrorCode::kLimit);
  EXPECT_THAT(to_string(far.error()), HasSubstr("800030 x 30 cells"));
  EXPECT_TRUE(stack_of_tiles(store, Rect{{-2, 0}, {3, 3}}));
}

TEST(StoredMap, OnlyCellsOfTheLatticeAreStored) {
  const auto stored = std::make_shared<StoredTiles>();
  MemoryStore store(metre_tiles(), stored);
  const auto what_of = [&](const GridGeometry& geometry, GridStackOptions options = {}) {
    GridStack stack = GridStack::create(geometry, std::move(options)).value();
    EXPECT_TRUE(stack.replace_cells("/ism/a", random_grid(geometry, 1, 9)));
    const auto put = store_stack(stack, store);
    return put ? std::string() : to_string(put.error());
  };
  GridGeometry geometry{.resolution_m = 0.1, .origin = {0.3, -7.7}, .cols = 5, .rows = 5};
  EXPECT_EQ(what_of(geometry), "");
  geometry.origin.x() = 0.35;
  EXPECT_THAT(what_of(geometry), HasSubstr("whole multiples"));
  geometry.origin.x() = 0.3;
  geometry.yaw_rad = 0.1;
  EXPECT_THAT(what_of(geometry), HasSubstr("unturned"));
  geometry.yaw_rad = 0.0;
  geometry.resolution_m = 0.2;
  EXPECT_THAT(what_of(geometry), HasSubstr("cells of 0.1 m"));
  EXPECT_THAT(what_of({.resolution_m = 0.1, .cols = 1, .rows = 1}, {.frame_id = "lab"}),
              HasSubstr("'lab'"));
}

TEST(StoredMap, ATileKeepsTheRulesOfItsLattice) {
  const TileLattice lattice = metre_tiles();
  const GridGeometry cells = geometry_of(lattice, {.first = {1, 2}}).value();
  StackTile tile{.index = {1, 2}};
  EXPECT_TRUE(validate(tile, lattice));
  tile.layers.emplace("/ism/a", random_grid(cells, 1, 5));
  EXPECT_TRUE(validate(tile, lattice));
  tile.index = {1, 3};
  EXPECT_THAT(to_string(validate(tile, lattice).error()), HasSubstr("tile 1, 3"));
  tile.index = {1, 2};
  tile.datum = GeographicDatum{.longitude_deg = 200};
  EXPECT_EQ(validate(tile, lattice).error().field, "longitude_deg");
}

}  // namespace
}  // namespace hypermap

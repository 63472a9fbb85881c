// SPDX-License-Identifier: BSD-3-Clause
// A map of tiles is read while it is written: each tile is found as it was before or after, whole.
#include "hypermap/io/tiles/tile_folder.hpp"
#include "hypermap/projection/tiles/moving_region.hpp"
#include "hypermap/projection/tiles/stored_map.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"
#include "tile_builders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

namespace hypermap {
namespace {

TEST(TileReaders, FindWholeTilesWhileAWriterRuns) {
  const test::TempDir dir;
  const TileLattice lattice{.resolution_m = 0.1, .tile_cells = 32};
  // Every reading raises all cells of the region by one: within a tile all cells are alike, and
  // what a reader finds never falls.
  const GridGeometry region_cells = geometry_of(lattice, {.cols = 2, .rows = 2}).value();
  const SensorGrid reading{
      .layer = "/ism/a",
      .grid =
          LogOddsGrid::create(region_cells, std::vector<LogOddsSteps>(region_cells.num_cells(), 1))
              .value()};
  auto folder = std::make_unique<TileFolder>(TileFolder::create(dir.path(), lattice).value());
  MovingRegion region =
      MovingRegion::create(
          {3.2, 3.2}, std::move(folder), {.tile_cols = 2, .tile_rows = 2, .inner_margin_m = 1})
          .value();
  ASSERT_EQ(region.window().first, (TileIndex{0, 0}));
  ASSERT_TRUE(region.fuse(reading, test::pose(0, 0)));
  ASSERT_EQ(region.store_changes().value(), 4U);

  std::atomic<bool> is_done{false};
  std::atomic<int> num_read{0};
  const auto read = [&] {
    LogOddsSteps least = 1;
    while (!is_done) {
      const TileFolder opened = TileFolder::open(dir.path()).value();
      EXPECT_EQ(opened.list().value().size(), 4U);
      const StackTile tile = opened.get({1, 1}).value().value();
      const auto cells = tile.layers.at("/ism/a").cells();
      const LogOddsSteps value = cells.front();
      EXPECT_TRUE(std::ranges::all_of(cells, [&](LogOddsSteps steps) { return steps == value; }));
      EXPECT_GE(value, least);
      least = value;
      EXPECT_EQ(stack_of_tiles(opened).value().layers().at("/ism/a").num_known(), 4096U);
      ++num_read;
    }
  };
  std::thread first(read);
  std::thread second(read);
  for (int i = 0; i < test::repetitions(20); ++i) {
    EXPECT_TRUE(region.fuse(reading, test::pose(0, 0)));
    EXPECT_EQ(region.store_changes().value(), 4U);
  }
  is_done = true;
  first.join();
  second.join();
  EXPECT_GT(num_read, 0);
}

}  // namespace
}  // namespace hypermap

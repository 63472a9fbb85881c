// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/projection/tiles/moving_region.hpp"

#include "hypermap/projection/tiles/stored_map.hpp"
#include "region_builders.hpp"
#include "support/sanitized.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
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

TEST(MovingRegion, LiesAroundTheVehicleAndSaysWhere) {
  const MovingRegion region = region_at(0.5, 0.5, std::make_shared<StoredTiles>());
  EXPECT_EQ(region.window(), (TileWindow{.first = {-2, -1}, .cols = 5, .rows = 3}));
  EXPECT_EQ(region.stack().geometry().origin, Eigen::Vector2d(-2, -1));
  EXPECT_EQ(region.stack().geometry().cols, 50);
  EXPECT_EQ(region.stack().geometry().rows, 30);
  EXPECT_EQ(region.stack().options().frame_id, "map");
  const TileFrame frame = region.frame();
  EXPECT_EQ(frame.map_from_tile.frame_id, "map");
  EXPECT_EQ(frame.map_from_tile.child_frame_id, "map_tile_-2_-1");
  EXPECT_EQ(frame.map_from_tile.x_m, -2.0);
  EXPECT_EQ(frame.map_from_tile.y_m, -1.0);
  EXPECT_EQ(frame.map_from_tile.yaw_rad, 0.0);
  EXPECT_FALSE(frame.datum);
}

TEST(MovingRegion, CountsWhatIsKnownOutside) {
  // The region is [-2, 3] x [-1, 2] in cells of 0.1 m.
  MovingRegion region = region_at(0.5, 0.5, std::make_shared<StoredTiles>());
  const LogOddsGrid three = grid_of(sized(2, 2), {700, 0, -700, 700});
  ASSERT_TRUE(region.fuse(reading(three), pose(0, 0)));
  EXPECT_EQ(region.num_outside(), 0U);
  const double edge_m = three.geometry().resolution_m;
  // One column of the two lies beyond x = 3: of its cells the upper one is known.
  ASSERT_TRUE(region.fuse(reading(three), pose(3.0 - edge_m, 0)));
  EXPECT_EQ(region.num_outside(), 1U);
  // The upper row lies beyond y = 2: both of its cells are known.
  ASSERT_TRUE(region.fuse(reading(three), pose(0, 2.0 - edge_m)));
  EXPECT_EQ(region.num_outside(), 3U);
  ASSERT_TRUE(region.follow({2.9, 0.5}).value());
  EXPECT_EQ(region.num_outside(), 3U) << "a move loses nothing";
}

TEST(MovingRegion, StaysWhileTheVehicleIsWithinTheInnerBounds) {
  // The region is [-2, 3] x [-1, 2], its inner bounds [-1.2, 2.2] x [-0.2, 1.2].
  MovingRegion region = region_at(0.5, 0.5, std::make_shared<StoredTiles>());
  for (const auto& [x, y] : {std::pair{2.19, 0.5}, {-1.19, 1.19}, {0.5, -0.19}, {2.19, 1.19}}) {
    EXPECT_FALSE(region.follow({x, y}).value()) << x << " " << y;
  }
  EXPECT_FALSE(region.last_stack());
  const auto change = region.follow({2.3, 0.5}).value();
  ASSERT_TRUE(change);
  EXPECT_EQ(change->left.map_from_tile.child_frame_id, "map_tile_-2_-1");
  EXPECT_EQ(change->entered.map_from_tile.child_frame_id, "map_tile_0_-1");
  EXPECT_EQ(change->entered, region.frame());
  EXPECT_EQ(region.window().first, (TileIndex{0, -1}));
  // There it rests: no pose makes it move twice.
  EXPECT_FALSE(region.follow({2.3, 0.5}).value());
}

TEST(MovingRegion, CellsThatStayAreCarriedOverAndThoseThatLeaveComeBack) {
  const auto stored = std::make_shared<StoredTiles>();
  MovingRegion region = region_at(0.5, 0.5, stored);
  // A cell in tile (-2, 0), one in tile (2, 0).
  ASSERT_EQ(region.fuse(reading(grid_of(sized(1, 1), {700})), pose(-1.9, 0.3)).value(), 1U);
  ASSERT_EQ(region.fuse(reading(grid_of(sized(1, 1), {-300}), "/ism/b"), pose(2.4, 0.3)).value(),
            1U);
  const GridStack before = region.stack();

  const auto away = region.follow({3.5, 0.5}).value();
  ASSERT_TRUE(away);
  EXPECT_EQ(away->num_stored, 1U);
  EXPECT_EQ(away->num_loaded, 0U);
  EXPECT_EQ(region.last_stack(), before);
  // Cell (2.4, 0.3) is now column 14, row 13 of [1, 6] x [-1, 2].
  EXPECT_EQ(region.stack().layers().at("/ism/b").at({14, 13}), -300);
  EXPECT_EQ(region.stack().layers().at("/ism/b").num_known(), 1U);
  EXPECT_EQ(region.stack().layers().at("/ism/a").num_known(), 0U);
  ASSERT_EQ(stored->tiles.size(), 1U);
  EXPECT_EQ(stored->tiles.begin()->first, (TileIndex{-2, 0}));
  EXPECT_EQ(stored->tiles.begin()->second.layers.size(), 1U);

  const auto back = region.follow({0.5, 0.5}).value();
  ASSERT_TRUE(back);
  EXPECT_EQ(back->num_stored, 0U);
  EXPECT_EQ(back->num_loaded, 1U);
  EXPECT_EQ(region.stack(), before);
  EXPECT_EQ(back->entered, away->left);
}

TEST(MovingRegion, WholeTilesThereAndBackChangeNothing) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto stored = std::make_shared<StoredTiles>();
    MovingRegion region = region_at(0.5, 0.5, stored);
    for (const char* layer : {"/ism/a", "/ism/b"}) {
      ASSERT_TRUE(region.fuse(reading(random_grid(sized(50, 30), seed, 900), layer), pose(-2, -1)));
    }
    const GridStack before = region.stack();
    CounterRng random(seed, 3);
    for (int i = 0; i < test::repetitions(40); ++i) {
      ASSERT_TRUE(region.follow({random.uniform(-20, 20), random.uniform(-20, 20)}));
    }
    ASSERT_TRUE(region.follow({40, 40}));
    ASSERT_TRUE(region.follow({0.5, 0.5}));
    EXPECT_EQ(region.stack(), before);
    // What was stored once and did not change is not stored again.
    EXPECT_EQ(stored->num_puts, 15);
  }
}

TEST(MovingRegion, TilesAndRegionHoldWhatOneLargeStackDoes) {
  // A drive in loops of which every tile is left and entered several times; readings of any pose
  // and resolution, on two layers, so strong that cells saturate, and with forgetting: the order
  // counts.
  const auto stored = std::make_shared<StoredTiles>();
  const GridStackOptions options{.max_log_odds = LogOdds(4.0), .keep_share = 0.97};
  const TileLattice lattice = metre_tiles();
  MovingRegion region =
      MovingRegion::create(
          {0, 0},
          std::make_unique<MemoryStore>(lattice, stored),
          {.tile_cols = 4, .tile_rows = 4, .inner_margin_m = 1.5, .stack = options})
          .value();
  GridStack large =
      GridStack::create(geometry_of(lattice, {.first = {-12, -12}, .cols = 24, .rows = 24}).value(),
                        options)
          .value();
  std::size_t num_changes = 0;
  const int num_readings = test::repetitions(1200);
  for (int i = 0; i < num_readings; ++i) {
    const double turn = 0.02 * i;
    const Eigen::Vector2d vehicle(7 * std::sin(turn), 7 * std::sin(1.3 * turn + 0.4));
    if (region.follow(vehicle).value()) ++num_changes;
    // At most 1 m across its diagonal, around the vehicle: within 1.5 m.
    const auto seed = static_cast<std::uint64_t>(i);
    const SensorGrid sensor = reading(random_grid(sized(9, 7, i % 3 == 0 ? 0.1 : 0.083), seed, 900),
                                      i % 2 == 0 ? "/ism/a" : "/ism/b");
    const Eigen::Matrix3d map_from_sensor =
        pose(vehicle.x(), vehicle.y(), 1.1 * i) * pose(-0.4, -0.3);
    EXPECT_EQ(region.fuse(sensor, map_from_sensor).value(),
              large.fuse(sensor, map_from_sensor).value());
  }
  EXPECT_GT(num_changes, 20U);
  ASSERT_TRUE(region.store_changes());
  EXPECT_EQ(region.store_changes().value(), 0U);
  const MemoryStore store(lattice, stored);
  const Rect area{{-12, -12}, {12, 12}};
  EXPECT_EQ(stack_of_tiles(store, area, options).value(), large);
}

TEST(MovingRegion, AStoredMapIsGoneOnWith) {
  const auto stored = std::make_shared<StoredTiles>();
  GridStack before = [&] {
    MovingRegion region = region_at(0.5, 0.5, stored);
    EXPECT_TRUE(region.fuse(reading(random_grid(sized(30, 30), 9, 700)), pose(-1, -1)));
    EXPECT_EQ(region.store_changes().value(), 9U);
    return region.stack();
  }();
  MovingRegion again = region_at(0.5, 0.5, stored);
  EXPECT_EQ(again.stack(), before);
  ASSERT_TRUE(again.follow({30, 30}));
  EXPECT_EQ(stored->num_puts, 9);  // nothing had changed
}

TEST(MovingRegion, EvidenceThatCancelsOutIsForgottenInTheStoreToo) {
  const auto stored = std::make_shared<StoredTiles>();
  MovingRegion region = region_at(0.5, 0.5, stored);
  ASSERT_TRUE(region.fuse(reading(grid_of(sized(1, 1), {500})), pose(0.5, 0.5)));
  ASSERT_EQ(region.store_changes().value(), 1U);
  ASSERT_TRUE(region.fuse(reading(grid_of(sized(1, 1), {-500})), pose(0.5, 0.5)));
  ASSERT_EQ(region.store_changes().value(), 1U);
  EXPECT_TRUE(stored->tiles.at({0, 0}).layers.empty());
  // A tile of which nothing was ever known is not stored.
  ASSERT_TRUE(region.fuse(reading(grid_of(sized(1, 1), {500})), pose(1.5, 0.5)));
  ASSERT_TRUE(region.fuse(reading(grid_of(sized(1, 1), {-500})), pose(1.5, 0.5)));
  EXPECT_EQ(region.store_changes().value(), 0U);
  EXPECT_EQ(stored->tiles.size(), 1U);
}

TEST(MovingRegion, ANameStandsForOnePose) {
  MovingRegion region = region_at(0.5, 0.5, std::make_shared<StoredTiles>());
  std::map<std::string, FrameTransform> announced;
  CounterRng random(4, 4);
  for (int i = 0; i < 200; ++i) {
    const auto change = region.follow({random.uniform(-9, 9), random.uniform(-9, 9)}).value();
    if (!change) continue;
    const FrameTransform& pose_of = change->entered.map_from_tile;
    const auto [known, is_new] = announced.emplace(pose_of.child_frame_id, pose_of);
    EXPECT_EQ(known->second, pose_of);
  }
  EXPECT_GT(announced.size(), 20U);
  // All of them can be frames of one tree at a time: none contradicts another.
  FrameTree frames;
  for (const auto& [name, transform] : announced) EXPECT_TRUE(frames.add(transform)) << name;
}

TEST(MovingRegion, TheDatumIsThatOfTheTilesCorner) {
  const auto stored = std::make_shared<StoredTiles>();
  MovingRegion region = region_at(0.5, 0.5, stored);
  const GeographicDatum map_datum{
      .latitude_deg = 52.03, .longitude_deg = 8.49, .altitude_m = 101, .yaw_rad = 0.2};
  ASSERT_TRUE(region.set_datum(map_datum));
  EXPECT_EQ(region.frame().datum, shifted(map_datum, {-2, -1}));
  ASSERT_TRUE(region.fuse(reading(grid_of(sized(1, 1), {5})), pose(2.5, 1.5)));
  ASSERT_TRUE(region.store_changes());
  EXPECT_EQ(stored->tiles.at({2, 1}).datum, shifted(map_datum, {2, 1}));
  const auto failed = region.set_datum(GeographicDatum{.latitude_deg = 91});
  EXPECT_EQ(failed.error().field, "latitude_deg");
  EXPECT_EQ(region.frame().datum, shifted(map_datum, {-2, -1}));
  ASSERT_TRUE(region.set_datum(std::nullopt));
  EXPECT_FALSE(region.frame().datum);
}

TEST(MovingRegion, FramesSayWhereASensorStands) {
  MovingRegion region = region_at(0.5, 0.5, std::make_shared<StoredTiles>());
  FrameTree frames;
  ASSERT_TRUE(frames.add({.frame_id = "map", .child_frame_id = "lidar", .x_m = 0.4, .y_m = 0.2}));
  ASSERT_TRUE(frames.add(region.frame().map_from_tile));
  SensorGrid sensor = reading(grid_of(sized(1, 1), {9}));
  sensor.frame_id = "lidar";
  ASSERT_EQ(region.fuse(sensor, frames).value(), 1U);
  EXPECT_EQ(region.stack().layers().at("/ism/a").at({24, 12}), 9);
  // In the frame that was announced the same cell is column 24, row 12 from its origin.
  sensor.frame_id = "map_tile_-2_-1";
  sensor.grid = grid_of({.resolution_m = 0.1, .origin = {2.4, 1.2}, .cols = 1, .rows = 1}, {9});
  ASSERT_EQ(region.fuse(sensor, frames).value(), 1U);
  EXPECT_EQ(region.stack().layers().at("/ism/a").at({24, 12}), 18);
  const GridStack before = region.stack();
  sensor.frame_id = "moon";
  EXPECT_EQ(region.fuse(sensor, frames).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(region.stack(), before);
}

TEST(MovingRegion, ARegionOfOneCellFollows) {
  const auto stored = std::make_shared<StoredTiles>();
  MovingRegion region =
      MovingRegion::create(
          {0.5, 0.5},
          std::make_unique<MemoryStore>(TileLattice{.resolution_m = 1.0, .tile_cells = 1}, stored),
          {.tile_cols = 1, .tile_rows = 1, .inner_margin_m = 0.0})
          .value();
  for (int x = 0; x < 10; ++x) {
    ASSERT_TRUE(region.follow({x + 0.5, 0.5}));
    const auto says = static_cast<LogOddsSteps>(x + 1);
    ASSERT_EQ(region.fuse(reading(grid_of(sized(1, 1, 1.0), {says})), pose(x, 0)).value(), 1U);
  }
  ASSERT_TRUE(region.store_changes());
  const GridStack all =
      stack_of_tiles(MemoryStore({.resolution_m = 1.0, .tile_cells = 1}, stored)).value();
  EXPECT_THAT(all.layers().at("/ism/a").cells(),
              testing::ElementsAre(1, 2, 3, 4, 5, 6, 7, 8, 9, 10));
}

}  // namespace
}  // namespace hypermap

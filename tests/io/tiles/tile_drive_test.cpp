// SPDX-License-Identifier: BSD-3-Clause
// A long drive with a small region over tiles on the disk, against one large grid in memory.
#include "hypermap/io/tiles/tile_folder.hpp"
#include "hypermap/projection/tiles/moving_region.hpp"
#include "hypermap/projection/tiles/stored_map.hpp"
#include "projection/stack/grid_builders.hpp"
#include "support/sanitized.hpp"
#include "support/temp_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

constexpr double kSide = 50.0;      // m, of the place
constexpr double kInset = 1.2;      // m, of the way from its edge
constexpr double kStep = 0.6;       // m, between readings
constexpr double kMetres = 1000.0;  // of the drive
constexpr int kSources = 8;         // different readings

/// Tiles of 3 m with cells of 1 cm, four of which make the region of 6 x 6 m.
TileLattice drive_lattice() {
  return {.frame_id = "odom", .resolution_m = 0.01, .tile_cells = 300};
}

/// To and fro in lanes 2.38 m apart: 20 of them, 47.6 m each.
Eigen::Vector2d place_on_way(double metres) {
  constexpr double kLane = kSide - 2 * kInset;
  constexpr double kApart = kLane / 20;
  const double turn = std::floor(metres / (kLane + kApart));
  const double along = metres - turn * (kLane + kApart);
  const double x = std::min(along, kLane);
  const double y = kApart * turn + std::max(along - kLane, 0.0);
  const bool is_back = static_cast<int>(turn) % 2 == 1;
  return {kInset + (is_back ? kLane - x : x), kInset + y};
}

struct DriveStep {
  Eigen::Vector2d vehicle;
  SensorGrid sensor;
  Eigen::Matrix3d map_from_sensor;
};

/// What is sensed at each place: at most 1.5 m away, turned as it comes, of cells of any size.
DriveStep step_of(int number) {
  static const std::vector<LogOddsGrid> kReadings = [] {
    std::vector<LogOddsGrid> grids;
    for (int i = 0; i < kSources; ++i) {
      const double resolution_m = i % 2 == 0 ? 0.02 : 0.013;
      const int side = static_cast<int>(1.2 / resolution_m);
      const auto seed = static_cast<std::uint64_t>(i);
      grids.push_back(test::random_grid(test::sized(side, side, resolution_m), seed, 3000));
    }
    return grids;
  }();
  DriveStep step{.vehicle = place_on_way(kStep * number), .sensor = {}, .map_from_sensor = {}};
  step.sensor = {.layer = number % 3 == 0 ? "/ism/camera" : "/ism/laser",
                 .frame_id = "sensor",
                 .grid = kReadings[static_cast<std::size_t>(number) % kSources]};
  step.map_from_sensor =
      test::pose(step.vehicle.x(), step.vehicle.y(), 0.37 * number) * test::pose(-0.6, -0.6);
  return step;
}

double resident_mib() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmRSS:") continue;
    double kib = 0.0;
    status >> kib;
    return kib / 1024.0;
  }
  return 0.0;
}

TEST(TileDrive, AKilometreInASmallRegionIsOneLargeGrid) {
  const test::TempDir dir;
  const int num_steps = static_cast<int>((test::kSanitized ? kMetres / 10 : kMetres) / kStep);
  const MovingRegionOptions options{.tile_cols = 2, .tile_rows = 2, .inner_margin_m = 1.5};
  std::size_t num_loaded = 0;
  double first_mib = 0.0;
  {
    auto store =
        std::make_unique<TileFolder>(TileFolder::create(dir.path(), drive_lattice()).value());
    MovingRegion region = MovingRegion::create(place_on_way(0), std::move(store), options).value();
    for (int i = 0; i < num_steps; ++i) {
      const DriveStep step = step_of(i);
      if (const auto change = region.follow(step.vehicle).value()) num_loaded += change->num_loaded;
      ASSERT_TRUE(region.fuse(step.sensor, step.map_from_sensor));
      if (i == num_steps / 10) first_mib = resident_mib();
    }
    // Many tiles do not stay in memory: a tenth of the way takes what all of it does. Under a
    // sanitizer freed memory is kept.
    if (!test::kSanitized) {
      EXPECT_LT(resident_mib(), first_mib + 4.0);
    }
    ASSERT_TRUE(region.store_changes());
  }
  const double whole = kSide / drive_lattice().resolution_m;
  GridStack large =
      GridStack::create({.resolution_m = 0.01,
                         .cols = static_cast<int>(whole),
                         .rows = static_cast<int>(test::kSanitized ? whole / 5 : whole)},
                        {.frame_id = "odom"})
          .value();
  for (int i = 0; i < num_steps; ++i) {
    const DriveStep step = step_of(i);
    ASSERT_TRUE(large.fuse(step.sensor, step.map_from_sensor));
  }
  const TileFolder stored = TileFolder::open(dir.path()).value();
  const GridStack reassembled = stack_of_tiles(stored, bounds(large.geometry())).value();
  EXPECT_EQ(reassembled, large);

  // Complete: every tile of which the large grid knows a cell, and no other.
  std::set<TileIndex> known;
  for (const auto& [name, grid] : large.layers()) {
    for (int row = 0; row < grid.geometry().rows; ++row) {
      for (int col = 0; col < grid.geometry().cols; ++col) {
        if (grid.at({col, row}) != 0) known.insert({col / 300, row / 300});
      }
    }
  }
  const auto listed = stored.list().value();
  EXPECT_EQ(std::set<TileIndex>(listed.begin(), listed.end()), known);
  if (!test::kSanitized) {
    EXPECT_GT(known.size(), 270U);
    EXPECT_GT(num_loaded, 200U);
  }
}

}  // namespace
}  // namespace hypermap

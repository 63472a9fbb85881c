// SPDX-License-Identifier: BSD-3-Clause
// Maps of map_server by others: they are read as they are meant, and saved as what was read.
#include "hypermap/io/archive/map_archive.hpp"
#include "hypermap/io/archive/map_server.hpp"
#include "support/hostile_index.hpp"
#include "support/temp_dir.hpp"
#include "support/test_data.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace hypermap {
namespace {

/// One real map and what it must hold.
struct RealMap {
  const char* path;
  int cols;
  int rows;
  double least_free;  ///< Share of the cells.
};

class RealMaps : public ::testing::TestWithParam<RealMap> {};

TEST_P(RealMaps, LoadInBothDialectsWithPlausibleCounts) {
  const RealMap& expected = GetParam();
  HYPERMAP_REQUIRE_SHARED_DATA(std::string("maps2d/") + expected.path);
  for (const MapDialect dialect : {MapDialect::kHypermap, MapDialect::kMapServer}) {
    const auto map = read_map(test::shared_data("maps2d") / expected.path, dialect);
    ASSERT_TRUE(map) << to_string(map.error());
    const GridGeometry& geometry = map->value.grid.geometry();
    EXPECT_EQ(geometry.cols, expected.cols);
    EXPECT_EQ(geometry.rows, expected.rows);
    const OccupancyCounts counts = map->value.grid.counts();
    const auto total = static_cast<double>(geometry.num_cells());
    EXPECT_GE(static_cast<double>(counts.free), expected.least_free * total);
    const bool is_scale = std::string(expected.path).find("speed") != std::string::npos;
    EXPECT_EQ(counts.between > 0, is_scale);
    EXPECT_GT(counts.occupied + counts.between, 0U);
  }
}

TEST_P(RealMaps, AreTheSameWhenTheyWereSavedAndLoadedAgain) {
  const std::string path = std::string("maps2d/") + GetParam().path;
  HYPERMAP_REQUIRE_SHARED_DATA(path);
  for (const MapDialect dialect : {MapDialect::kHypermap, MapDialect::kMapServer}) {
    const auto map = read_map(test::shared_data(path), dialect);
    ASSERT_TRUE(map) << to_string(map.error());
    MapArchive archive;
    ASSERT_TRUE(archive.hypermap.add_layer({{.name = "plan"}, map->value}));
    const test::TempDir dir;
    ASSERT_TRUE(save_archive(archive, dir / "map.hmap"));
    const auto loaded = load_archive(dir / "map.hmap");
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    const auto* plan = loaded->value.hypermap.find_as<OccupancyLayer>("plan");
    ASSERT_NE(plan, nullptr);
    EXPECT_EQ(plan->grid, map->value.grid);
    const MapFiles raw = write_raw_map(map->value, "plan.pgm").value();
    std::ofstream(dir / "plan.yaml") << raw.yaml;
    std::ofstream(dir / "plan.pgm", std::ios::binary) << raw.image;
    const auto again = read_map(dir / "plan.yaml", dialect);
    ASSERT_TRUE(again) << to_string(again.error());
    EXPECT_EQ(again->value.grid, map->value.grid);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Corpus,
    RealMaps,
    ::testing::Values(
        RealMap{"nav2/nav2_bringup__maps/depot.yaml", 604, 307, 0.3},
        RealMap{"nav2/nav2_bringup__maps/depot_keepout.yaml", 604, 307, 0.3},
        RealMap{"nav2/nav2_bringup__maps/depot_speed.yaml", 604, 307, 0.0},
        RealMap{"nav2/nav2_bringup__maps/tb3_sandbox.yaml", 384, 384, 0.05},
        RealMap{"nav2/nav2_bringup__maps/warehouse.yaml", 1006, 1674, 0.3},
        RealMap{"nav2/nav2_costmap_2d__test__map/TenByTen.yaml", 10, 10, 0.3},
        RealMap{"nav2/nav2_map_server__test/testmap.yaml", 10, 10, 0.1},
        RealMap{"nav2/nav2_system_tests__maps/keepout_mask.yaml", 384, 384, 0.05},
        RealMap{"nav2/nav2_system_tests__maps/map_circular.yaml", 384, 384, 0.05},
        RealMap{"nav2/nav2_system_tests__maps/speed_mask.yaml", 384, 384, 0.0},
        RealMap{"nav2/tools__smoother_benchmarking__maps/smoothers_world.yaml", 300, 300, 0.3},
        RealMap{"turtlebot_apps/turtlebot_navigation__maps/willow-2010-02-18-0.10.yaml",
                566,
                608,
                0.1}),
    [](const auto& map) { return test::test_name_of(map.param.path); });

}  // namespace
}  // namespace hypermap

// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/jobs/tile_set.hpp"

#include "io/archive/wide_map.hpp"
#include "support/synthetic_dataset.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class TileSetTest : public testing::Test {
 protected:
  void SetUp() override {
    map.views.clear();  // whose pictures are none
    for (const char* name : {"cup", "table", "vase"}) EXPECT_TRUE(map.classes.add(name));
    const auto split = run_split(map, {.edge_m = 2.5, .output = folder});
    ASSERT_TRUE(split) << to_string(split.error());
    set = read_tile_set(folder).value();
  }

  test::TempDir dir;
  std::filesystem::path folder = dir / "tiles";
  MapArchive map = test::wide_map();
  TileSet set;
};

TEST_F(TileSetTest, TheIndexIsReadAsItWasWritten) {
  EXPECT_TRUE(is_tile_set(folder));
  EXPECT_TRUE(is_tile_set(folder / "tiles.json"));
  EXPECT_FALSE(is_tile_set(dir.path()));
  EXPECT_FALSE(is_tile_set(folder / set.tiles[0].file));
  EXPECT_EQ(set.edge_m, 2.5);
  EXPECT_EQ(set.folder, folder);
  EXPECT_EQ(read_tile_set(folder / "tiles.json").value().tiles.size(), set.tiles.size());
  EXPECT_EQ(set.tiles[0].file, "tile_-2_-2.hmap");
  EXPECT_EQ(set.tiles[0].area, (Rect{{-5, -5}, {-2.5, -2.5}}));
  EXPECT_TRUE((set.tiles[0].reach.min.array() <= set.tiles[0].area.min.array()).all());
}

TEST_F(TileSetTest, OnlyWhatIsAskedIsRead) {
  const Rect asked{{0.1, 0.1}, {0.2, 0.2}};
  const std::vector<std::size_t> reached = tiles_reached(set, asked);
  EXPECT_LT(reached.size(), set.tiles.size());
  for (std::size_t i = 0; i < set.tiles.size(); ++i) {
    if (std::ranges::find(reached, i) == reached.end()) {
      std::filesystem::remove(folder / set.tiles[i].file);
    }
  }
  const auto loaded = load_tiles(set, reached, {});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const MapArchive& part = loaded->value.map;
  for (const Object& object : map.objects.objects()) {
    const Eigen::Vector2d near = object.box.min_in_map.head<2>().cwiseMax(asked.min).cwiseMin(
        object.box.max_in_map.head<2>());
    const bool is_there =
        (near.array() >= asked.min.array()).all() && (near.array() <= asked.max.array()).all();
    EXPECT_TRUE(!is_there || part.objects.contains(object.id)) << object.id.value;
  }
  EXPECT_EQ(load_tiles(set, tiles_reached(set, std::nullopt), {}).error().code, ErrorCode::kIo);
}

/// Places of vertices with those of the vertices that they are joined to.
std::multiset<std::vector<double>> graph_of(const TopologicalMap& places) {
  std::multiset<std::vector<double>> graph;
  for (std::uint32_t i = 0; i < places.vertices().size(); ++i) {
    const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      graph.insert({a.x(), a.y(), a.z(), b.x(), b.y(), b.z()});
    };
    const Eigen::Vector3d here = places.vertices()[i].position_in_map;
    add(here, here);
    for (const VertexId other : places.neighbours(VertexId{i})) {
      add(here, places.vertices()[other.value].position_in_map);
    }
  }
  return graph;
}

TEST_F(TileSetTest, AllTilesHaveTheVerticesAndWaysOfTheWholeMap) {
  const auto loaded = load_tiles(set, tiles_reached(set, std::nullopt), {});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  ASSERT_FALSE(set.ways.empty());
  EXPECT_EQ(graph_of(*loaded->value.map.topological_map), graph_of(*map.topological_map));
}

TEST_F(TileSetTest, OfSomeTilesEachObjectHasAVertex) {
  const auto loaded = load_tiles(set, {0, 1, 4}, {});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const TopologicalMap& places = *loaded->value.map.topological_map;
  for (const Object& object : loaded->value.map.objects.objects()) {
    const auto near = places.nearest(object.centroid_in_map);
    ASSERT_TRUE(near);
    EXPECT_LT((places.vertices()[near->value].position_in_map - object.centroid_in_map).norm(),
              places.options().vertex_distance_m);
  }
}

TEST_F(TileSetTest, AnObjectThatJutsOutIsReachedFromBeside) {
  TileSet two{.edge_m = 1,
              .tiles = {{.file = "a.hmap", .area = {{0, 0}, {1, 1}}, .reach = {{0, 0}, {1.4, 1}}},
                        {.file = "b.hmap", .area = {{1, 0}, {2, 1}}, .reach = {{1, 0}, {2, 1}}}}};
  EXPECT_THAT(tiles_reached(two, Rect{{1.3, 0.5}, {1.3, 0.5}}), ElementsAre(0, 1));
  EXPECT_THAT(tiles_reached(two, Rect{{1.5, 0.5}, {1.5, 0.5}}), ElementsAre(1));
  EXPECT_THAT(tiles_reached(two, Rect{{5, 5}, {6, 6}}), IsEmpty());
  EXPECT_THAT(tiles_reached(two, std::nullopt), ElementsAre(0, 1));
}

TEST_F(TileSetTest, NoTilesStandForWhatAllHave) {
  const auto loaded = load_tiles(set, {}, {});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_TRUE(loaded->value.map.classes.find("chair"));
}

TEST_F(TileSetTest, IndicesOfStrangersAreRefusedByPlace) {
  const auto refusal = [&](const std::string& index) {
    test::write_text(folder / "tiles.json", index);
    const auto read = read_tile_set(folder);
    return read ? "none" : to_string(read.error());
  };
  const std::string rest = R"(, "voxels": 1, "objects": 0})";
  const std::string tile = R"({"file": "a.hmap", "area": [0, 0, 1, 1])" + rest;
  const auto with = [](const std::string& tiles) {
    return R"({"tile_m": 1, "tiles": [)" + tiles + "]}";
  };
  EXPECT_EQ(refusal(with(tile)), "none");
  EXPECT_THAT(refusal(with("")), HasSubstr("$.tiles: names no tile"));
  EXPECT_THAT(refusal(with(tile + "," + tile)),
              HasSubstr("$.tiles[1]: 'a.hmap' stands there twice"));
  EXPECT_THAT(refusal(with(R"({"file": "../a.hmap", "area": [0, 0, 1, 1])" + rest)),
              HasSubstr("$.tiles[0].file: must be the name of an archive beside the index"));
  EXPECT_THAT(refusal(with(R"({"file": "a.txt", "area": [0, 0, 1, 1])" + rest)), HasSubstr("file"));
  EXPECT_THAT(refusal(with(R"({"file": "a.hmap", "area": [0, 0, 0, 1])" + rest)),
              HasSubstr("$.tiles[0].area: must be [x, y, x, y] from low to high"));
  EXPECT_THAT(refusal(with(R"({"file": "a.hmap", "area": [0, 0, 1])" + rest)), HasSubstr("area"));
  const std::string known = tile.substr(0, tile.size() - 1) + R"(, "vertices": 2})";
  const auto joined_by = [&](const std::string& way) {
    return R"({"tile_m": 1, "tiles": [)" + known + R"(], "ways": [)" + way + "]}";
  };
  EXPECT_EQ(refusal(joined_by("[0, 0, 0, 1]")), "none");
  for (const char* way : {"[0, 0, 0, 2]", "[1, 0, 0, 1]"}) {
    EXPECT_THAT(refusal(joined_by(way)),
                HasSubstr("$.ways[0]: must be [tile, vertex, tile, vertex] of the tiles"));
  }
  EXPECT_THAT(refusal("{"), HasSubstr("tiles.json:1"));
}

}  // namespace
}  // namespace hypermap

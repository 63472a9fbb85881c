// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/tile_folder.hpp"

#include "hypermap/io/tiles/tile_file.hpp"
#include "hypermap/projection/tiles/stored_map.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"
#include "tile_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace hypermap {
namespace {

using test::files_below;
using test::sample_tile;
using test::small_tiles;
using test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

TEST(TileFolder, TilesAreFilesByTheirNames) {
  const TempDir dir;
  TileFolder folder = TileFolder::create(dir / "a/b", small_tiles()).value();
  EXPECT_TRUE(folder.list().value().empty());
  EXPECT_FALSE(folder.get({0, 0}).value());
  ASSERT_TRUE(folder.put(sample_tile({3, -1}, 1)));
  ASSERT_TRUE(folder.put(sample_tile({-20, 6}, 2)));
  EXPECT_THAT(folder.list().value(), ElementsAre(TileIndex{-20, 6}, TileIndex{3, -1}));
  EXPECT_EQ(folder.get({3, -1}).value(), sample_tile({3, -1}, 1));
  const auto files = files_below(dir / "a/b");
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files.at("tile_3_-1_logodds_0.1m_at_2.4000000000000004m_-0.8m.tile"),
            encode_tile(sample_tile({3, -1}, 1), small_tiles()).value());
  ASSERT_TRUE(folder.put(sample_tile({3, -1}, 9)));
  EXPECT_EQ(folder.get({3, -1}).value(), sample_tile({3, -1}, 9));
  EXPECT_EQ(files_below(dir / "a/b").size(), 2U);
}

TEST(TileFolder, IsOpenedByItsTilesAlone) {
  const TempDir dir;
  EXPECT_EQ(TileFolder::open(dir / "none").error().code, ErrorCode::kIo);
  EXPECT_EQ(TileFolder::open(dir.path()).error().code, ErrorCode::kNotFound);
  TileFolder folder = TileFolder::create(dir.path(), small_tiles()).value();
  ASSERT_TRUE(folder.put(sample_tile({0, 0}, 1)));
  std::ofstream(dir / "notes.txt") << "not ours";
  fs::create_directory(dir / "more.tile");
  const TileFolder opened = TileFolder::open(dir.path()).value();
  EXPECT_EQ(opened.lattice(), small_tiles());
  EXPECT_EQ(opened.list().value().size(), 1U);
  EXPECT_EQ(opened.get({0, 0}).value(), sample_tile({0, 0}, 1));
}

TEST(TileFolder, TilesOfAnotherLatticeAreNotMixedIn) {
  const TempDir dir;
  ASSERT_TRUE(TileFolder::create(dir.path(), small_tiles()).value().put(sample_tile({0, 0}, 1)));
  const auto what_of = [&](const TileLattice& lattice) {
    const auto made = TileFolder::create(dir.path(), lattice);
    return made ? std::string() : to_string(made.error());
  };
  EXPECT_EQ(what_of(small_tiles()), "");
  EXPECT_THAT(what_of({.frame_id = "map", .resolution_m = 0.1, .tile_cells = 8}),
              HasSubstr("holds tiles of 8 cells of 0.1 m in frame 'odom', expected 8 cells of 0.1 "
                        "m in frame 'map'"));
  EXPECT_THAT(what_of({.frame_id = "odom", .resolution_m = 0.2, .tile_cells = 8}),
              HasSubstr("0.2"));
  EXPECT_THAT(what_of({.frame_id = "odom", .resolution_m = 0.1, .tile_cells = 9}), HasSubstr("9"));
}

TEST(TileFolder, AFileThatIsNotItsTileIsRefused) {
  const TempDir dir;
  TileFolder folder = TileFolder::create(dir.path(), small_tiles()).value();
  ASSERT_TRUE(folder.put(sample_tile({0, 0}, 1)));
  const fs::path first = dir / tile_file_name(small_tiles(), {0, 0}).value();
  const fs::path other = dir / tile_file_name(small_tiles(), {1, 0}).value();
  fs::copy_file(first, other);
  EXPECT_THAT(to_string(folder.get({1, 0}).error()), HasSubstr("holds tile 0, 0"));
  EXPECT_THAT(to_string(stack_of_tiles(folder).error()), HasSubstr(other.string()));
  // One that is called as no tile would be missed.
  fs::rename(other, dir / "tile_1_0_logodds_0.1m_at_0.7m_0m.tile");
  EXPECT_THAT(to_string(folder.list().error()), HasSubstr("is not called as a tile"));
  EXPECT_THAT(to_string(folder.list().error()),
              HasSubstr("by its content it must be called " + first.filename().string()));
  fs::rename(dir / "tile_1_0_logodds_0.1m_at_0.7m_0m.tile", dir / "tile_99999999999_0_.tile");
  EXPECT_THAT(to_string(folder.list().error()), HasSubstr("is not called as a tile"));
  fs::remove(dir / "tile_99999999999_0_.tile");
  fs::resize_file(first, 40);
  EXPECT_EQ(folder.get({0, 0}).error().code, ErrorCode::kMalformedFile);
  EXPECT_THAT(to_string(TileFolder::open(dir.path()).error()), HasSubstr(first.string()));
}

TEST(TileFolder, ATileThatIsRefusedLeavesTheOldOne) {
  const TempDir dir;
  TileFolder folder = TileFolder::create(dir.path(), small_tiles()).value();
  ASSERT_TRUE(folder.put(sample_tile({0, 0}, 1)));
  const auto before = files_below(dir.path());
  StackTile wrong = sample_tile({0, 0}, 2);
  wrong.index = {0, 1};
  EXPECT_FALSE(folder.put(wrong));
  wrong.index = {0, 0};
  wrong.datum = GeographicDatum{.latitude_deg = 100};
  EXPECT_FALSE(folder.put(wrong));
  EXPECT_EQ(files_below(dir.path()), before);
}

}  // namespace
}  // namespace hypermap

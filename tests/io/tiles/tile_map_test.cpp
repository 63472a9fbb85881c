// SPDX-License-Identifier: BSD-3-Clause
#include "hypermap/io/tiles/tile_map.hpp"

#include "hypermap/io/tiles/tile_folder.hpp"
#include "support/temp_dir.hpp"
#include "tile_builders.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using test::sample_tile;
using test::small_tiles;
using test::TempDir;
using testing::ElementsAre;
using testing::HasSubstr;

/// A file of the public implementation, 2 rows x 3 columns of 0.5 m; INT8, 16 is 1000 steps.
struct SogmFile {
  int second = 0;
  std::string layer = "-cam";
  std::string x = "0";
  std::string y = "0";
  std::vector<std::int8_t> cells = {};
  std::string resolution = "500mm";
  std::string more = "";
};

std::string write_file(const TempDir& dir, const SogmFile& file) {
  std::string name = "What_OGM_T_" + std::to_string(file.second) +
                     ".000000000s.ns_Format_INT8_Unit_logodds_Layer_" + file.layer + "_Res_" +
                     file.resolution + "_X_" + file.x + "m_Y_" + file.y + "m_Z_0m_" + file.more +
                     "rows_2_cols_3_lat_1_lon_2_alt_3_.bin";
  std::ofstream out(dir / name, std::ios::binary);
  for (const std::int8_t cell : file.cells) out.put(static_cast<char>(cell));
  return name;
}

TEST(TileMap, TilesOfThePublicImplementationBecomeOneStack) {
  const TempDir dir;
  write_file(dir, {.second = 1, .cells = {16, 16, 16, 32, 32, 32}});
  // One column to the right, later: it knows its right column and one cell of the overlap.
  write_file(dir, {.second = 2, .x = "0.5", .cells = {0, 48, 48, 0, 0, 48}});
  write_file(
      dir,
      {.second = 1, .layer = "-ism-laser", .x = "-0.5", .y = "0.5", .cells = {-16, 0, 0, 0, 0, 0}});
  const GridStack stack = stack_of_sogm_tiles(dir.path()).value();
  EXPECT_EQ(stack.geometry().origin, Eigen::Vector2d(-0.5, 0));
  EXPECT_EQ(stack.geometry().cols, 5);
  EXPECT_EQ(stack.geometry().rows, 3);
  EXPECT_THAT(stack.layers().at("/ism/cam").cells(),
              ElementsAre(0,
                          1000,
                          1000,
                          3000,
                          3000,  //
                          0,
                          2000,
                          2000,
                          2000,
                          3000,  //
                          0,
                          0,
                          0,
                          0,
                          0));
  // A topic that is below the parent keeps its name.
  const LogOddsGrid& laser = stack.layers().at("/ism/laser");
  EXPECT_EQ(laser.at({0, 1}), -1000);
  EXPECT_EQ(laser.num_known(), 1U);
  EXPECT_EQ(stack.layers().size(), 2U);
}

TEST(TileMap, TimeAndNotTheOrderOfNamesCounts) {
  const TempDir dir;
  write_file(dir, {.second = 10, .cells = {16, 16, 16, 16, 16, 16}});
  write_file(dir, {.second = 9, .cells = {-16, -16, -16, -16, -16, -16}});
  const GridStack stack = read_tile_map(dir.path()).value();
  EXPECT_THAT(stack.layers().at("/ism/cam").cells(), testing::Each(1000));
}

TEST(TileMap, AnAreaIsReadAlone) {
  const TempDir dir;
  write_file(dir, {.cells = {1, 2, 3, 4, 5, 6}});
  write_file(dir, {.x = "100000", .cells = {16, 16, 16, 16, 16, 16}});
  write_file(dir, {.x = "-100000", .cells = {16, 16, 16, 16, 16, 16}});
  // All of it is 400,003 columns wide.
  const auto all = read_tile_map(dir.path());
  EXPECT_EQ(all.error().code, ErrorCode::kLimit);
  EXPECT_THAT(to_string(all.error()), HasSubstr("400003 x 2 cells"));
  const GridStack part = read_tile_map(dir.path(), Rect{{0.6, 0.1}, {1.4, 0.9}}).value();
  EXPECT_EQ(part.geometry().origin, Eigen::Vector2d(0.5, 0));
  EXPECT_THAT(part.layers().at("/ism/cam").cells(), ElementsAre(125, 188, 313, 375));
  EXPECT_EQ(read_tile_map(dir.path(), Rect{{9, 9}, {10, 10}}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(read_tile_map(dir.path(), Rect{{9, 9}, {9, 10}}).error().code,
            ErrorCode::kInvalidArgument);
}

TEST(TileMap, ATileBetweenTheCellsIsResampled) {
  const TempDir dir;
  write_file(dir, {.second = 1, .cells = {16, 16, 16, 16, 16, 16}});
  // A quarter turn about (5, 0): columns run up, rows to the left. And one half a cell aside.
  write_file(
      dir,
      {.second = 2, .layer = "-b", .x = "5", .cells = {1, 2, 3, 4, 5, 6}, .more = "yaw_90deg_"});
  write_file(dir, {.second = 3, .layer = "-c", .x = "0.25", .cells = {16, 16, 16, 16, 16, 16}});
  const GridStack stack = read_tile_map(dir.path()).value();
  EXPECT_EQ(stack.geometry().cols, 10);
  EXPECT_EQ(stack.geometry().rows, 3);
  const LogOddsGrid& turned = stack.layers().at("/ism/b");
  EXPECT_EQ(turned.at({9, 0}), 63);
  EXPECT_EQ(turned.at({9, 2}), 188);
  EXPECT_EQ(turned.at({8, 1}), 313);
  EXPECT_THAT(stack.layers().at("/ism/c").cells().subspan(0, 5),
              ElementsAre(500, 1000, 1000, 500, 0));
}

TEST(TileMap, WhatDoesNotFitTogetherIsRefused) {
  const TempDir dir;
  EXPECT_EQ(read_tile_map(dir / "none").error().code, ErrorCode::kIo);
  EXPECT_EQ(read_tile_map(dir.path()).error().code, ErrorCode::kNotFound);
  const std::string sound = write_file(dir, {.cells = {1, 2, 3, 4, 5, 6}});
  const std::string coarse =
      write_file(dir, {.second = 2, .cells = {1, 2, 3, 4, 5, 6}, .resolution = "1m"});
  EXPECT_THAT(to_string(read_tile_map(dir.path()).error()),
              testing::AllOf(HasSubstr(coarse), HasSubstr("cells of 1 m, others of 0.5 m")));
  std::filesystem::remove(dir / coarse);
  const std::string cut = write_file(dir, {.second = 3, .cells = {1, 2, 3}});
  EXPECT_THAT(to_string(read_tile_map(dir.path()).error()),
              testing::AllOf(HasSubstr(cut), HasSubstr("has 3 bytes")));
  std::filesystem::remove(dir / cut);
  std::ofstream(dir / "What_OGM.bin") << "x";
  EXPECT_THAT(to_string(read_tile_map(dir.path()).error()), HasSubstr("What_OGM.bin"));
  std::filesystem::remove(dir / "What_OGM.bin");
  EXPECT_TRUE(read_tile_map(dir.path()));
  ASSERT_TRUE(TileFolder::create(dir.path(), small_tiles()).value().put(sample_tile({0, 0}, 1)));
  EXPECT_THAT(to_string(read_tile_map(dir.path()).error()), HasSubstr("two kinds"));
}

TEST(TileMap, OurTilesAreReadAsTheyAre) {
  const TempDir dir;
  TileFolder folder = TileFolder::create(dir.path(), small_tiles()).value();
  ASSERT_TRUE(folder.put(sample_tile({1, -1}, 1)));
  const GridStack stack = read_tile_map(dir.path()).value();
  EXPECT_EQ(stack.options().frame_id, "odom");
  EXPECT_EQ(stack.layers(), sample_tile({1, -1}, 1).layers);
}

}  // namespace
}  // namespace hypermap

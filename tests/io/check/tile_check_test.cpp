// SPDX-License-Identifier: BSD-3-Clause
// Tiles and folders of them as `check` reports them.
#include "hypermap/io/check/file_check.hpp"
#include "hypermap/io/tiles/tile_file.hpp"
#include "hypermap/io/tiles/tile_folder.hpp"
#include "support/temp_dir.hpp"
#include "support/text_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace hypermap {
namespace {

using ::testing::HasSubstr;

class TileCheck : public ::testing::Test {
 protected:
  /// One tile of 2 x 2 cells; its file.
  std::filesystem::path put(TileIndex index) {
    const TileLattice lattice{.frame_id = "map", .resolution_m = 0.5, .tile_cells = 2};
    const GridGeometry cells = geometry_of(lattice, {.first = index}).value();
    StackTile tile{.index = index, .layers = {}, .datum = {}};
    tile.layers.emplace("/ism/a", LogOddsGrid::create(cells, {1, 2, 3, 4}).value());
    TileFolder folder = TileFolder::create(dir_.path(), lattice).value();
    EXPECT_TRUE(folder.put(tile));
    return dir_ / tile_file_name(lattice, index).value();
  }

  test::TempDir dir_;
};

TEST_F(TileCheck, ATileByItsOwnNameIsFine) {
  const FileCheckResult result = check_file(put({3, -1}));
  EXPECT_EQ(result.exit_code(), 0);
  EXPECT_THAT(result.summary, HasSubstr("2 x 2 cells"));
}

TEST_F(TileCheck, AnotherNameThanThatOfItsContentIsAFinding) {
  const auto file = put({3, -1});
  // A tile's name, but of its neighbour; and no tile's name at all.
  for (const char* name : {"tile_4_-1_logodds_0.5m_at_4m_-1m.tile", "room.tile"}) {
    const auto renamed = dir_ / name;
    std::filesystem::copy_file(file, renamed);
    const FileCheckResult result = check_file(renamed);
    ASSERT_EQ(result.exit_code(), 1) << name;
    EXPECT_THAT(to_string(result.findings.front().error),
                HasSubstr("must be called " + file.filename().string()));
    EXPECT_EQ(check_file(renamed, {.strict = true}).exit_code(), 2);
    std::filesystem::remove(renamed);
  }
}

TEST_F(TileCheck, AFolderIsCheckedTileByTile) {
  put({0, 0});
  const auto file = put({1, 0});
  EXPECT_EQ(check_file(dir_.path()).exit_code(), 0);
  EXPECT_EQ(check_file(dir_.path()).summary, "folder of 2 tiles");
  std::filesystem::rename(file, dir_ / "room.tile");
  const FileCheckResult renamed = check_file(dir_.path());
  ASSERT_EQ(renamed.exit_code(), 1);
  EXPECT_EQ(renamed.findings.front().error.file, (dir_ / "room.tile").string());
  test::write_text(dir_ / "cut.tile", "PK");
  const FileCheckResult cut = check_file(dir_.path());
  ASSERT_EQ(cut.exit_code(), 2);
  EXPECT_EQ(cut.findings.size(), 2U) << "one bad tile hides no other";
  EXPECT_THAT(to_string(cut.findings.front().error), HasSubstr("cut.tile: not a tile"));
}

}  // namespace
}  // namespace hypermap

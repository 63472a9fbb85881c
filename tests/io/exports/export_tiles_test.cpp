// SPDX-License-Identifier: BSD-3-Clause
// A map as a folder of tiles.
#include "hypermap/io/exports/map_export.hpp"
#include "hypermap/io/exports/map_stack.hpp"
#include "hypermap/io/tiles/tile_map.hpp"
#include "support/files_below.hpp"
#include "support/temp_dir.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace hypermap {
namespace {

using testing::HasSubstr;

/// A wall of voxels of 0.05 m along x from -8 m to 8 m, chairs and cups by turns, 0.5 m up.
MapArchive wall_archive() {
  MapArchive archive;
  for (const char* name : {"chair", "cup", "sofa"}) (void)archive.classes.add(name).value();
  archive.octree = SemanticOctree::create({}).value();
  for (int i = -160; i < 160; ++i) {
    const auto key = archive.octree->grid().key(PointInMap{{0.05 * (i + 0.5), 0.025, 0.525}});
    VoxelLabel label;
    label.classes[0] = {static_cast<std::uint16_t>(i % 2 == 0 ? 0 : 1), 2000};
    EXPECT_TRUE(archive.octree->set_leaf({.key = key.value(), .log_odds = 2000, .label = label}));
  }
  return archive;
}

Result<std::vector<std::filesystem::path>> tiles_of(const MapArchive& archive,
                                                    const std::filesystem::path& folder,
                                                    std::vector<std::string> classes = {}) {
  return export_map(archive,
                    {.format = ExportFormat::kTiles,
                     .output = folder,
                     .layer = {},
                     .classes = std::move(classes)});
}

TEST(ExportTiles, AreTheStackOfTheMap) {
  const test::TempDir dir;
  const MapArchive archive = wall_archive();
  // 256 cells are 12.8 m: -8 .. 8 m lie in tiles -1 and 0.
  const auto files = tiles_of(archive, dir / "tiles").value();
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].filename(), "tile_-1_0_logodds_0.05m_at_-12.8m_0m.tile");
  EXPECT_EQ(test::files_below(dir / "tiles").size(), 2U);
  const GridStack stack = stack_of_map(archive, {}).value();
  const GridStack back = read_tile_map(dir / "tiles", bounds(stack.geometry())).value();
  EXPECT_EQ(back.options().frame_id, stack.options().frame_id);
  ASSERT_EQ(back.layers().size(), 2U);
  for (const auto& [name, grid] : stack.layers()) {
    EXPECT_TRUE(std::ranges::equal(back.layers().at(name).cells(), grid.cells())) << name;
  }
}

TEST(ExportTiles, AnOlderExportIsReplacedAsAWhole) {
  const test::TempDir dir;
  ASSERT_TRUE(tiles_of(wall_archive(), dir / "tiles"));
  std::ofstream(dir / "tiles/tile_of_an_older_map.tile") << "x";
  ASSERT_TRUE(tiles_of(wall_archive(), dir / "tiles", {"cup"}));
  EXPECT_EQ(test::files_below(dir / "tiles").size(), 2U);
  EXPECT_EQ(read_tile_map(dir / "tiles").value().layers().size(), 1U);
}

TEST(ExportTiles, OtherFilesAreNotLost) {
  const test::TempDir dir;
  std::ofstream(dir / "thesis.txt") << "years";
  const auto before = test::files_below(dir.path());
  const auto refused = tiles_of(wall_archive(), dir.path());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(to_string(refused.error()), HasSubstr("thesis.txt"));
  EXPECT_FALSE(tiles_of(wall_archive(), dir / "thesis.txt"));
  EXPECT_FALSE(tiles_of(wall_archive(), dir / "new", {"sofa"}));
  EXPECT_FALSE(tiles_of(MapArchive(), dir / "new"));
  EXPECT_EQ(test::files_below(dir.path()), before);
  EXPECT_FALSE(std::filesystem::exists(dir / "new"));
}

}  // namespace
}  // namespace hypermap
